// SPDX-License-Identifier: MIT
#pragma once
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <osg/MatrixTransform>

namespace test {

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
