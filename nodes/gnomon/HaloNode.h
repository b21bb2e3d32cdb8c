// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/EffectNode.h>

#include <osg/Vec4f>

namespace gnomon {

/// Draws a halo: a coloured rim around its children, for example to show a selected object.
///
/// The children are drawn as usual and the rim never covers them. The rim is the outline of the enlarged children.
/// Objects nearer than the enlarged children hide it.
///
///     osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
///     halo->addChild(model);
///     halo->setScale(1.2);
///
/// HaloPulse makes a halo pulse.
///
/// Cost
/// - A second cull of the children, two more draws of them (stencil only), and one quad.
/// - PIXELS: about 3·w² + 3 draws, and not two, for a rim of w pixels.
/// Needs
/// - One stencil bit that is not reserved, see CompositorOptions. It is 0 again afterwards.
/// Limits
/// - The children must write depth.
/// - Shadows do not darken the rim. Transparent drawables blend over it.
/// - WHOLE and PARTS: a model that is not centred in its box gets a lopsided rim.
/// - PIXELS: the rim ends at the border of the view.
/// - Mirrors show no halos.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - M. Kilgard, halomagic.c.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::HaloNode {
///       UniqueID 2
///       Children 1 { osg::Geode { UniqueID 7 } }
///       Shape PARTS
///       Scale 1.2
///       Color 0.8 0.8 0 0.3
///     }
class GNOMON_EXPORT HaloNode : public EffectNode {
public:
    /// How the children are enlarged.
    enum Shape : int {
        WHOLE, ///< All together, about the centre of their common box.
        PARTS, ///< Each drawable about the centre of its own box. Better for models that are not convex.
        PIXELS ///< Not enlarged in space: the rim has one width on the screen.
    };

    /// A halo of shape WHOLE and scale 1, which is not visible.
    HaloNode() = default;
    /// Copies the properties.
    HaloNode(const HaloNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, HaloNode)

    /// Shape of the halo. Default WHOLE, which also replaces any unknown value.
    void setShape(Shape shape);
    /// See setShape().
    Shape getShape() const { return _shape; }

    /// Scale of WHOLE and PARTS, 1 (no halo) … 1000. Default 1. Clamped. NaN is refused with a warning.
    void setScale(double factor);
    /// See setScale().
    double getScale() const { return _scale; }

    /// Width of PIXELS on the screen, 0 (no halo) … 8 pixels. Default 3. Clamped.
    void setWidth(int pixels);
    /// See setWidth().
    int getWidth() const { return _width; }

    /// Red, green, blue and opacity of the rim, 0 … 1 each. Default (0.8, 0.8, 0, 0.3). Clamped.
    /// NaN is refused with a warning.
    void setColor(const osg::Vec4f& color);
    /// See setColor().
    const osg::Vec4f& getColor() const { return _color; }

    /// True if the shape's own scale or width gives a rim.
    bool isOn() const { return _shape == PIXELS ? _width > 0 : _scale > 1.0; }

    /// Bounds of the enlarged children.
    osg::BoundingSphere computeBound() const override;

protected:
    ~HaloNode() override = default;
    osg::ref_ptr<ViewEffect> makeEffect(osgUtil::CullVisitor& cull) override;

private:
    Shape _shape = WHOLE;
    double _scale = 1.0;
    int _width = 3;
    osg::Vec4f _color{0.8f, 0.8f, 0.0f, 0.3f};
};

} // namespace gnomon
