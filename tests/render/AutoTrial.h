// SPDX-License-Identifier: MIT
#pragma once
#include <support/Scene.h>
#include <support/Truth.h>

#include <gnomon/AutoShadowTechnique.h>

#include <string>
#include <vector>

namespace test {

/// A ground and casters under automatic choice.
struct AutoTrial {
    explicit AutoTrial(const std::vector<Mesh>& casters, const gnomon::AutoShadowOptions& options = {},
                       double half = 8.0, const osg::Vec4d& light = {1.0, 0.4, 1.2, 0.0})
        : scene(groundScene(casters, half, light)), technique(new gnomon::AutoShadowTechnique) {
        technique->setOptions(options);
        scene.addShadow(technique);
    }
    /// That of the only light and kind of receivers; an empty one if there are none or several.
    gnomon::ShadowDecision decision() const {
        const std::vector<gnomon::ShadowDecision> all = technique->lastDecision();
        return all.size() == 1 ? all.front() : gnomon::ShadowDecision();
    }
    std::string chosen() const { return decision().chosen.spec; }

    Scene scene;
    osg::ref_ptr<gnomon::AutoShadowTechnique> technique;
};

/// The same ground and casters lit and dark, beside the truth.
struct GroundTruth {
    GroundTruth(std::vector<Mesh> casters, double half, const osg::Vec4d& light, const View& view) {
        Scene all = groundScene(casters, half, light);
        lit = render(all.root, view);
        all.takeLightAway();
        dark = render(all.root, view);
        casters.push_back(square(half));
        truth = truthOf(casters, light, view);
    }
    /// Pixels, of 95 % of the edges.
    double edgesOffBy(const Picture& picture) const { return edgesOff(picture, lit, dark, truth).p95; }

    Picture lit, dark;
    gnomon::TruthImage truth;
};

} // namespace test
