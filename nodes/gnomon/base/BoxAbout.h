// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/Matrixd>

namespace gnomon {

/// The box about a box in another frame; invalid if that is.
inline osg::BoundingBoxd boxAbout(const osg::BoundingBox& box, const osg::Matrixd& frameFromLocal) {
    osg::BoundingBoxd inFrame;
    for (unsigned i = 0; box.valid() && i < 8; ++i) inFrame.expandBy(osg::Vec3d(box.corner(i)) * frameFromLocal);
    return inFrame;
}

} // namespace gnomon
