// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/StageEffectNode.h>

#include <osg/Vec3f>
#include <osg/Vec4d>

#include <memory>

namespace gnomon {

class SavedColors;

/// A flat mirror: the children, drawn as ever, are seen once more behind a surface, mirrored in its plane.
///
/// What of the surface one sees keeps the rest of its own colour: (1 - r) · own + r · mirrored, a channel each, r being
/// the reflectance. Outside the surface nothing is mirrored, nor from behind it, where it looks as it does without this.
/// Where nothing is mirrored the mirror shows the view's background. Lights are mirrored, too, wherever they stand.
/// Shadows that relight lie under the mirror image, in the surface's own share; those that blend darken both.
///
///     mirror->addChild(scene);
///     mirror->setSurface({floor});                    // in the scene, or beside it
///     mirror->setPlane(osg::Vec4d(0, 0, 1, 0));       // z = 0, reflecting upwards
///
/// Cost    a second cull of the children; one more draw of those that can be seen mirrored, two of the surface; a copy
///         of the surface's part of the screen.
/// Needs   one stencil bit that is not reserved, 0 again afterwards, for any number of mirrors; one of OpenGL's clip
///         planes, the sixth. A surface that is opaque.
/// Limits  a mirror shows no shadows, no halos and no mirrors but their surfaces as they are without; what cameras below
///         it draw is left out. Programs of the children must let OpenGL clip (gl_ClipVertex, or none). The surface may
///         be any shape, what it mirrors is mirrored in the plane. Framebuffer objects of several samples are refused.
/// Threads any number of cull and draw threads; set properties between frames.
/// Cure    the stencil keeps the image inside the surface; switched off, to show what it is for, the mirrored children
///         are seen beside it, too.
///
/// Source: M. Kilgard, halomagic.c.
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default, here the plane z = 0 facing up, no surface,
/// 0.7 of each channel, the cure on:
///
///     gnomon::PlanarReflectionNode {
///       UniqueID 2
///       Children 1 { osg::Geode { UniqueID 7 } }
///       Plane 0 1 0 -2.5
///       Surface { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Reflectance 0.9 0.6 0.4
///     }
class GNOMON_EXPORT PlanarReflectionNode : public StageEffectNode {
public:
    PlanarReflectionNode();
    PlanarReflectionNode(const PlanarReflectionNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, PlanarReflectionNode)

    /// Plane (a, b, c, d), a·x + b·y + c·z + d = 0 in this node's frame, normal towards the side that is mirrored;
    /// any length of normal. Default (0, 0, 1, 0). Kept as given; one that is degenerate or not finite mirrors
    /// nothing, and diagnose() says so.
    void setPlane(const osg::Vec4d& plane);
    const osg::Vec4d& getPlane() const { return _plane; }

    /// What the mirror image is seen in: it must be named. It is not mirrored itself.
    void setSurface(const Selection& surface) { _surface = surface; }
    const Selection& getSurface() const { return _surface; }

    /// Share of red, green and blue light that is mirrored, 0 (none) … 1 (all that is seen); default 0.7 each. Clamped;
    /// NaN is refused with a warning.
    void setReflectance(const osg::Vec3f& share);
    const osg::Vec3f& getReflectance() const { return _reflectance; }

    /// The image ends at the surface's edges. Default on.
    void setStencilCure(bool on) { _stencilCure = on; }
    bool getStencilCure() const { return _stencilCure; }

    /// The children and their mirror images.
    osg::BoundingSphere computeBound() const override;
    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PlanarReflectionNode() override;
    osg::ref_ptr<StageEffect> makeEffect(osgUtil::CullVisitor& cull) override;

private:
    osg::Vec4d _plane{0.0, 0.0, 1.0, 0.0};
    Selection _surface;
    osg::Vec3f _reflectance{0.7f, 0.7f, 0.7f};
    bool _stencilCure = true;
    std::shared_ptr<SavedColors> _saved; ///< a frame that is still drawn keeps it.
};

} // namespace gnomon
