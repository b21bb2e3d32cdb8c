// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/EffectNode.h>
#include <gnomon/NamesNodes.h>
#include <gnomon/ObservedNode.h>

#include <osg/Vec3f>
#include <osg/Vec4d>

#include <memory>

namespace gnomon {

class FrameColorCopy;

/// Draws a flat mirror: its children appear a second time in a surface, mirrored in a plane.
///
/// Use it for polished floors, still water and wall mirrors. It works beside shadows in one scene.
///
///     osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
///     mirror->addChild(scene);
///     mirror->setSurface({floor});              // in the scene, or beside it
///     mirror->setPlane(osg::Vec4d(0, 0, 1, 0)); // z = 0, reflecting upwards
///
/// A pixel of the surface shows (1 - r) · own + r · mirrored colour, where r is the reflectance of each channel.
/// The mirror image shows the view's background where no child is mirrored, and the lights are mirrored, too.
/// RELIGHT shadows darken the surface's own colour alone; BLEND shadows darken the mirror image as well.
///
/// Cost
/// - A second cull of the children.
/// - One more draw of the mirrored children in view, and two of the surface.
/// - A copy of the surface's part of the screen.
/// Needs
/// - One stencil bit that is not reserved, see CompositorOptions, for any number of mirrors. It is 0 again afterwards.
/// - OpenGL's sixth clip plane.
/// - An opaque surface.
/// Limits
/// - The mirror image has no shadows and no halos. Other mirrors in it show their plain surfaces.
/// - Nested cameras are not mirrored.
/// - Vertex shaders of the children must support OpenGL's clip planes, for example by writing gl_ClipVertex.
/// - The surface may have any shape, but the image is always that of the plane.
/// - The surface reflects on the plane's front side only.
/// - Multisampled framebuffer objects are refused.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - M. Kilgard, halomagic.c.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::PlanarReflectionNode {
///       UniqueID 2
///       Children 1 { osg::Geode { UniqueID 7 } }
///       Plane 0 1 0 -2.5
///       Surface { Mask 0xffffffff Node TRUE { osg::Geode { UniqueID 7 } } }
///       Reflectance 0.9 0.6 0.4
///     }
class GNOMON_EXPORT PlanarReflectionNode : public EffectNode, public NamesNodes {
public:
    /// A mirror in the plane z = 0, without a surface.
    PlanarReflectionNode();
    /// Copies the properties. A deep copy names its own copy of the surface.
    PlanarReflectionNode(const PlanarReflectionNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, PlanarReflectionNode)

    /// Mirror plane (a, b, c, d): a·x + b·y + c·z + d = 0 in this node's frame. Default (0, 0, 1, 0).
    /// Its normal points to the reflecting side and may have any length. A degenerate or non-finite plane mirrors
    /// nothing, and diagnose() says so.
    void setPlane(const osg::Vec4d& plane);
    /// The mirror plane, as given.
    const osg::Vec4d& getPlane() const { return _plane; }

    /// The surface that shows the mirror image. It must be set. It is not mirrored itself, and the mirror does not keep it.
    void setSurface(const Selection& surface) { _surface = surface; }
    /// See setSurface(). Null and the mask 0, which select nothing, if the node is gone.
    Selection getSurface() const { return _surface.in(*this); }

    /// Mirrored share of red, green and blue, 0 (none) … 1 (image only). Default 0.7 each. Clamped.
    /// NaN is refused with a warning.
    void setReflectance(const osg::Vec3f& share);
    /// See setReflectance().
    const osg::Vec3f& getReflectance() const { return _reflectance; }

    /// The surface, if one is named.
    std::vector<Selection> namedParts() const override;
    /// Bounds of the children and their mirror images.
    osg::BoundingSphere computeBound() const override;
    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PlanarReflectionNode() override;
    osg::ref_ptr<ViewEffect> makeEffect(osgUtil::CullVisitor& cull) override;

private:
    osg::Vec4d _plane{0.0, 0.0, 1.0, 0.0};
    ObservedSelection _surface;
    osg::Vec3f _reflectance{0.7f, 0.7f, 0.7f};
    std::shared_ptr<FrameColorCopy> _saved; ///< a frame that is still drawn keeps it.
};

} // namespace gnomon
