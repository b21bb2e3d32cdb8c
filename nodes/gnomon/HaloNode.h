// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/StageEffectNode.h>

#include <osg/Vec4f>

namespace gnomon {

/// A halo: a rim of one colour about the children, which are drawn as ever.
///
/// The rim never covers what one sees of the children, and each of its pixels is blended once, however many of their
/// triangles fall on it. It stands where the children, made larger, would be seen: what is nearer than those hides it.
///
///     halo->addChild(model);
///     halo->setScale(1.2);
///
/// Cost    a second cull of the children and two more draws, stencil only, and one quad; for PIXELS of width w about
///         3·w² + 3 draws instead of two: 29 at 3, 197 at 8.
/// Needs   one stencil bit that is not reserved, 0 again afterwards.
/// Limits  children that write depth. Drawn after shadows, which do not touch it, and before transparent things, which
///         are blended over it. A child that does not stand round its own centre gets a lopsided rim of WHOLE and PARTS;
///         one of PIXELS ends where the view ends, for what lies beyond is not drawn. Not seen in mirrors.
/// Threads any number of cull and draw threads; set properties between frames. HaloPulse makes it pulse.
/// Cure    the stencil; switched off, to show what it is for, every triangle of the larger children blends for itself,
///         up to as many times as the free stencil bits can count (at most 7), over the children, too.
///
/// Source: M. Kilgard, halomagic.c.
///
/// In a file (.osgt, .osgb, .osgx), where what is left out has its default, here WHOLE, no larger than the children, 3
/// pixels, his yellow at 30 %, the cure on:
///
///     gnomon::HaloNode {
///       UniqueID 2
///       Children 1 { osg::Geode { UniqueID 7 } }
///       Shape PARTS
///       Scale 1.2
///       Color 0.8 0.8 0 0.3
///     }
class GNOMON_EXPORT HaloNode : public StageEffectNode {
public:
    /// How the children are made larger.
    enum Shape : int {
        WHOLE, ///< all together, about the centre of the box that holds them.
        PARTS, ///< each drawable about the centre of its own box: better for what is not convex.
        PIXELS ///< not larger in space: the rim is of one width on the screen.
    };

    HaloNode() = default;
    HaloNode(const HaloNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, HaloNode)

    /// Default WHOLE, which any value that is none of them stands for too.
    void setShape(Shape shape);
    Shape getShape() const { return _shape; }

    /// How many times as large, of WHOLE and PARTS; default 1: no halo, as for anything less. Clamped to 1000; NaN is
    /// refused with a warning.
    void setScale(double factor);
    double getScale() const { return _scale; }

    /// Width of PIXELS, 0 (no halo) … 8; default 3. Clamped.
    void setWidth(int pixels);
    int getWidth() const { return _width; }

    /// Red, green, blue and opacity, 0 … 1 each; default (0.8, 0.8, 0, 0.3). Opacity 1 hides what is behind. Clamped;
    /// NaN is refused with a warning.
    void setColor(const osg::Vec4f& color);
    const osg::Vec4f& getColor() const { return _color; }

    /// Each pixel is blended once, and none of the children's. Default on.
    void setStencilCure(bool on) { _stencilCure = on; }
    bool getStencilCure() const { return _stencilCure; }

    /// True if there is a halo to draw.
    bool isOn() const { return _shape == PIXELS ? _width > 0 : _scale > 1.0; }

    osg::BoundingSphere computeBound() const override;

protected:
    ~HaloNode() override = default;
    osg::ref_ptr<StageEffect> makeEffect(osgUtil::CullVisitor& cull) override;

private:
    Shape _shape = WHOLE;
    double _scale = 1.0;
    int _width = 3;
    osg::Vec4f _color{0.8f, 0.8f, 0.0f, 0.3f};
    bool _stencilCure = true;
};

} // namespace gnomon
