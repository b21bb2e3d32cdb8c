// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>

#include <osg/Camera>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/TexGenNode>
#include <osg/Texture2D>

#include <deque>
#include <memory>
#include <string>

namespace gnomon::examples {

/// A scene's depths as a lamp sees them, in a texture of 512 × 512 texels of 16 bits: drawn into a framebuffer of its own
/// when they are asked for, inside a border of 2 texels of the nearest depth, and copied from there.
///
/// Limits  one context, one thread. A bias at look-up leaves light on what is closer behind its blocker than it.
/// Source: CS-4470, part 2, newshadowmap() of shad.c.
class DepthPass {
public:
    static constexpr int size = 512, border = 2; ///< texels.

    explicit DepthPass(osg::Node& scene);
    ~DepthPass();
    DepthPass(const DepthPass&) = delete;
    DepthPass& operator=(const DepthPass&) = delete;

    /// To be put into the graph, above no transform that counts.
    osg::Camera* camera() { return _camera; }
    /// Compares: a look-up says whether a depth is at most that of the map, weighted over 2 × 2 texels.
    osg::Texture2D* texture() { return _texture; }

    /// Draws it anew in the next frame, from elsewhere or as it was.
    void lookFrom(const osg::Matrixd& view, const osg::Matrixd& projection);
    void redraw() { _camera->setNodeMask(~0u); }
    /// Where in the texture a point is, and how deep: 0 … 1 each after division by w.
    osg::Matrixd textureFromScene() const;

    /// Draws surfaces deeper by as much as their slope changes depth within a texel. Default on.
    void setDisplaced(bool on);
    /// Copies from framebuffer to texture without the CPU between; default on. Off: read back and sent again.
    void setFastCopy(bool on);
    /// How often it was drawn.
    int drawn() const;

private:
    class Copy;

    osg::ref_ptr<osg::Camera> _camera = new osg::Camera;
    osg::ref_ptr<osg::Texture2D> _texture = new osg::Texture2D;
    osg::ref_ptr<Copy> _copy;
};

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

/// Spotlights on some things, the sum of their passes, and the view from one of them.
class AddedLamps {
public:
    /// @param count  1 … AddedLamp::most.
    AddedLamps(osg::Node& things, int count);

    /// Lights that nothing but these may be added to: there is no ambient light beside theirs.
    osg::Group* node() { return _node; }
    AddedLamp& operator[](std::size_t i) { return _lamps[i]; }
    const AddedLamp& operator[](std::size_t i) const { return _lamps[i]; }

    /// Lets them be the lights of a group, too, whose shadows take away what passes leave out.
    void shineOn(ShadowCasterGroup& group);
    /// See DepthPass; all maps are drawn anew.
    void setMaps(bool fastCopy, bool displaced);
    /// "maps drawn: 1 1 4", how often each.
    std::string mapsDrawn() const;

    /// Draws the passes, or nothing but the lamps.
    void showPasses(bool on);
    void showBoxes(bool on) { _boxes->setNodeMask(on ? ~0u : 0u); }
    /// Of depth at look-up, -1 … 1 from near to far.
    void setBias(float bias) { _bias->set(bias); }
    void setBicubic(bool on) { _bicubic->set(on); }
    /// Sees the things as from a lamp, in its light alone, without shadows, which are what it does not see.
    /// @param aspect  width to height.
    void lookFrom(const osg::Matrixd& view, double aspect);
    void showView(bool on) { _view->setNodeMask(on ? ~0u : 0u); }

private:
    void setUpView(osg::Node& casters);

    osg::ref_ptr<osg::Group> _node = new osg::Group, _boxes = new osg::Group;
    osg::ref_ptr<osg::Camera> _view = new osg::Camera;
    osg::ref_ptr<osg::Uniform> _bias = new osg::Uniform("bias", 0.0f), _bicubic = new osg::Uniform("bicubic", false);
    std::deque<AddedLamp> _lamps;
};

} // namespace gnomon::examples
