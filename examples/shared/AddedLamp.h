// SPDX-License-Identifier: MIT
#pragma once
#include "DepthPass.h"

#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/TexGenNode>

#include <memory>

namespace gnomon::examples {

/// One of several spotlights that have a depth map and a pass each: the first pass draws, the others are added to it, so
/// that each light's shadow keeps what the others send. A map modulates all of its pass, so the shadow takes the light's
/// own ambient light, too. Outside its map, a square, a lamp gives no light.
///
/// Source: CS-4470, part 2, drawit() of shad.c.
class AddedLamp {
public:
    static constexpr double zNear = 0.1, zFar = 10.0, fieldOfView = 40.0; ///< of its map, degrees.
    static constexpr int most = 4;

    /// @param number  0 … most - 1: OpenGL's light; 0 is the first pass. @param things  what it lights.
    /// @param casters  what its map holds.
    AddedLamp(int number, osg::Node& things, osg::Node& casters);

    /// Light and pass, to be put beside the others'. Above it are uniforms "bias" (float: of depth at look-up, -1 … 1 from
    /// near to far) and "bicubic" (bool: 4 × 4 texels instead of 2 × 2).
    osg::Group* node() { return _node; }
    osg::LightSource* source() { return _source; }
    /// A small box in the lamp's colour, before its near plane.
    osg::Node* box() { return _box; }
    DepthPass& map() { return *_map; }
    const DepthPass& map() const { return *_map; }

    /// The map is drawn anew. @param view  of the things, from the lamp.
    void place(const osg::Matrixd& view);
    /// @param share  of the colour that it sends out.
    void setColor(const osg::Vec3& color, float share);
    void showPass(bool on) { _pass->setNodeMask(on ? ~0u : 0u); }

private:
    void setUpPass(int number);

    osg::ref_ptr<osg::Group> _node = new osg::Group, _pass = new osg::Group;
    osg::ref_ptr<osg::LightSource> _source = new osg::LightSource;
    osg::ref_ptr<osg::MatrixTransform> _box = new osg::MatrixTransform;
    osg::ref_ptr<osg::TexGenNode> _inMap = new osg::TexGenNode;
    std::unique_ptr<DepthPass> _map;
};

} // namespace gnomon::examples
