// SPDX-License-Identifier: MIT
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/FaceCulling.h>

#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/TriangleFunctor>

namespace gnomon {
namespace {

using Attribute = osg::StateAttribute;

/// Looks for a triangle that is not culled.
struct SeenFace {
    osg::Matrixd clipFromLocal;
    double sign = 1.0; ///< of what is seen; counter-clockwise triangles are positive.
    bool found = false;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) {
        if (found) return;
        osg::Vec3d corners[3];
        const osg::Vec3* locals[] = {&a, &b, &c};
        for (int i = 0; i < 3; ++i) {
            const osg::Vec4d clip = osg::Vec4d(osg::Vec3d(*locals[i]), 1.0) * clipFromLocal;
            corners[i] = {clip.x(), clip.y(), clip.w()}; // homogeneous: right behind the eye, too
        }
        found = sign * (corners[0] * (corners[1] ^ corners[2])) > 0.0;
    }
};

} // namespace

bool areAllFacesCulled(const osgUtil::RenderLeaf& leaf) {
    if (!isOn(leaf._parent, GL_CULL_FACE)) return false;
    const auto* culled = resolved<osg::CullFace>(leaf._parent, Attribute::CULLFACE);
    const auto* front = resolved<osg::FrontFace>(leaf._parent, Attribute::FRONTFACE);
    const auto mode = culled ? culled->getMode() : osg::CullFace::BACK;
    if (mode == osg::CullFace::FRONT_AND_BACK) return true;
    osg::TriangleFunctor<SeenFace> faces;
    if (!leaf._drawable->supports(faces)) return false;
    faces.clipFromLocal = modelviewOf(leaf) * projectionOf(leaf);
    const bool isClockwise = front && front->getMode() == osg::FrontFace::CLOCKWISE;
    faces.sign = isClockwise == (mode == osg::CullFace::BACK) ? -1.0 : 1.0;
    leaf._drawable->accept(faces);
    return !faces.found;
}

} // namespace gnomon
