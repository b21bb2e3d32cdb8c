// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapTechnique.h>

#include <osg/MatrixTransform>
#include <support/Scene.h>
#include <support/Truth.h>

#include <optional>
#include <string>
#include <vector>

namespace test {

/// Meshes that all cast and receive, under one light.
struct TracedCase {
    std::string name;
    std::vector<Mesh> meshes; ///< the first is named "ground".
    osg::Vec4d light;
    View view;

    Scene build() const;
    gnomon::TruthImage truth() const { return truthOf(meshes, light, view); }
};

/// A sun. @param azimuth,elevation  degrees: from +x towards +y, and above the level.
osg::Vec4d sunAt(double azimuth, double elevation);
/// The same with meshes, light and view turned together: what the eye sees stays.
TracedCase turned(TracedCase given, const osg::Matrixd& turn);
/// So that nothing is level and nothing flat along an axis, and grounds are in maps as any caster is.
TracedCase tilted(TracedCase given);

/// A sphere and a house on a ground.
TracedCase labEight();
/// 400 houses.
TracedCase townOfHouses();
/// A lamp and three things in a closed room.
TracedCase room();
/// Four rows of houses along a street of 2 km, as one who stands in it sees it.
/// @param azimuth  of the sun, degrees from where one looks.
TracedCase longStreet(double azimuth, double elevation = 15.0);
/// A level square of `side` × `side` small ones under a sun, see sunAt(), seen from `height`.
TracedCase flatGround(double half, double height, double elevation, double near, double far, int side = 1);

/// A case without shadows and what rays find of it, against which pictures with shadows are held.
struct Judge {
    explicit Judge(const TracedCase& of);
    /// The first frame with a technique's shadows.
    Picture with(const osg::ref_ptr<gnomon::ShadowTechnique>& technique) const;
    /// Found when it is first asked for.
    const gnomon::TruthImage& truth() const;
    TruthComparison compare(const Picture& actual) const { return test::compare(actual, lit, dark, truth()); }
    /// Pixels: of the edges, 95 % are less off.
    double edgesOff(const Picture& actual) const { return test::edgesOff(actual, lit, dark, truth()).p95; }
    double shareOff(const Picture& actual) const { return test::shareOff(actual, lit, dark, truth()); }

    TracedCase given;
    Picture lit, dark; ///< see compare() of support/Truth.h.

private:
    mutable std::optional<gnomon::TruthImage> _truth;
};

/// What a technique draws of a case.
struct CaseTrial : Judge {
    CaseTrial(const osg::ref_ptr<gnomon::ShadowTechnique>& technique, const TracedCase& from)
        : Judge(from), cast(with(technique)), comparison(compare(cast)), causes(technique->diagnose()) {}

    Picture cast;
    TruthComparison comparison;
    std::vector<std::string> causes;
};

/// Pixels about which pictures differ in a block of 3 × 3: edges that are off by less are thinner.
int differingBlocks(const Picture& a, const Picture& b);

/// A case with one caster more, which can be moved, seen by a camera that can be turned; and what its maps cost.
struct MovingCase {
    MovingCase(const TracedCase& asked, const Mesh& caster, gnomon::ShadowMapTechnique* shadow)
        : given(asked), technique(shadow) {
        mover->addChild(node(caster));
        scene.content->addChild(mover);
        scene.addShadow(technique);
    }
    /// Maps drawn in the next frame.
    unsigned passesInFrame() {
        const unsigned before = technique->passes();
        camera.frame();
        return technique->passes() - before;
    }
    /// From where the case does, and then moved or turned as the eye sees it.
    void look(const osg::Matrixd& from) {
        View view = given.view;
        view.view = view.view * from;
        camera.setView(view);
    }

    TracedCase given;
    Scene scene = given.build();
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    osg::ref_ptr<gnomon::ShadowMapTechnique> technique;
    Camera camera{scene.root, given.view};
};

} // namespace test
