// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osg/Texture2D>

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

} // namespace gnomon::examples
