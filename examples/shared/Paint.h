// SPDX-License-Identifier: MIT
#pragma once
#include <osg/LightSource>
#include <osg/Node>
#include <osg/Texture2D>

#include <functional>

namespace gnomon::examples {

/// Gives a node a matt colour, lit or not, and returns it.
osg::ref_ptr<osg::Node> painted(osg::ref_ptr<osg::Node> node, const osg::Vec4& color);
osg::ref_ptr<osg::Node> paintedUnlit(osg::ref_ptr<osg::Node> node, const osg::Vec4& color);

/// A texture of size × size texels, repeated, nearest texel. @param color  of column, row; from the lower left.
osg::ref_ptr<osg::Texture2D> drawnTexture(int size, const std::function<osg::Vec3(int column, int row)>& color);

/// A parallelogram with texture coordinates 0 … repeats along both sides, normal side × up.
osg::ref_ptr<osg::Node> texturedQuad(const osg::Vec3d& corner, const osg::Vec3d& side, const osg::Vec3d& up,
                                     double repeats = 1.0);

/// Light 0, white without specular light, on below `root`, where normals are kept at length 1; the scene's ambient light
/// is 0.2, OpenGL's own.
osg::ref_ptr<osg::LightSource> addLight(osg::Group& root, const osg::Vec4d& place);

} // namespace gnomon::examples
