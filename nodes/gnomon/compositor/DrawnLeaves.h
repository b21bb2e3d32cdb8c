// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Mark.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/Selection.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/TriangleClusters.h>

#include <osg/ColorMask>
#include <osg/StateAttribute>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>

#include <cstring>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// What blends hides what is behind it where its alpha is this or more: of the two it shows the more of.
constexpr float hidingAlpha = 0.5f;

/// A leaf that a stage draws, and the innermost bin that draws it.
struct DrawnLeaf {
    osgUtil::RenderLeaf* leaf;
    osgUtil::RenderBin* bin;
};

/// A leaf may lack a matrix, as osgSim's light points do: it is drawn as with the identity.
const osg::Matrixd& matrixOf(const osg::RefMatrix* matrix);
inline const osg::Matrixd& modelviewOf(const osgUtil::RenderLeaf& leaf) { return matrixOf(leaf._modelview.get()); }
inline const osg::Matrixd& projectionOf(const osgUtil::RenderLeaf& leaf) { return matrixOf(leaf._projection.get()); }

/// True if two matrices are the same to the last bit, signs of zeros included.
inline bool hasSameBits(const osg::Matrixd& a, const osg::Matrixd& b) {
    return std::memcmp(a.ptr(), b.ptr(), 16 * sizeof(double)) == 0;
}

/// True if two views have the same lens: the same but for near and far, which a nested camera finds for itself.
bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b);

/// True if two places are the same, but for the rounding of a product that is taken in another order.
/// @param rounding  of coordinates on the way there, if they are larger than those in eye space.
bool isSamePlace(const osg::Matrixd& a, const osg::Matrixd& b, double rounding);

/// Where drawables stand in eye space, to be asked for by drawable and place.
class DrawablePlaces {
public:
    void add(const osg::Drawable& drawable, const osg::Matrixd& place);
    bool empty() const { return _places.empty(); }
    /// True if the drawable stands anywhere.
    bool has(const osg::Drawable& drawable) const;
    /// True if the drawable stands there: see isSamePlace().
    bool hasAt(const osg::Drawable& drawable, const osg::Matrixd& place, double rounding = 0.0) const;

private:
    struct Place {
        const osg::Drawable* drawable;
        double along;       ///< an axis, on which those of a grid are apart.
        std::size_t matrix; ///< in _matrices.
    };
    using Order = std::vector<unsigned>;
    bool isIn(const osg::Drawable& drawable) const;
    const osg::Drawable** slotOf(const osg::Drawable& drawable) const;
    bool isAt(const Place& known, const osg::Matrixd& place, double rounding) const;
    /// Those of a drawable between two places along the axis.
    std::pair<Order::const_iterator, Order::const_iterator> between(const osg::Drawable& drawable, double low,
                                                                    double high) const;

    std::vector<Place> _places;
    std::vector<osg::Matrixd> _matrices; ///< of places; those that follow each other mostly share one.
    mutable Order _order;                ///< by drawable and axis, once those asked for come in another order.
    mutable std::vector<const osg::Drawable*> _drawables; ///< a table of them by address, once any is missed.
    mutable unsigned _next = 0;                           ///< The place after that which was found last.
    mutable osg::Matrixd _asked; ///< The place that was asked for last, and which of _matrices it was found to be.
    mutable std::size_t _asIn = ~std::size_t{0};
};

/// Every leaf that the stage draws before bin `number`, in the order in which it is drawn. Valid from the end of sort
/// to the end of draw.
std::vector<DrawnLeaf> leavesBelow(osgUtil::RenderStage& stage, int number);

/// The same of one bin.
std::vector<DrawnLeaf> leavesIn(osgUtil::RenderBin& bin);

/// Those of them that draw part of `receiver`. Reads the scene graph: call in cull.
///
/// Cost    a look at what is above each leaf. Where a node hands the cull others than its children, as osgTerrain's tiles do,
///         a visit of what is under the receiver.
/// @param scene  a node of the graph that is culled.
LeafSet receiversAmong(const std::vector<DrawnLeaf>& leaves, const Selection& receiver,
                       const osg::Matrixd& eyeFromWorld, const osg::Node& scene);

/// Those of some drawables that lie under `selection`, by some way from above. Reads the scene graph: call in cull.
std::set<const osg::Drawable*>
drawablesUnder(const Selection& selection, const std::vector<const osg::Drawable*>& drawables, const osg::Node& scene);

/// Why none of the leaves that a stage draws before its ShadowBin is of `selection`, as a cause for diagnose(); empty if
/// it merely is out of sight. @param role  what the selection is to be: "receiver". @param from  a node of the graph.
std::string whyMissing(const Selection& selection, const char* role, const osg::Node& from,
                       osgUtil::RenderStage& stage);

/// True if any of the leaves is drawn with `mode` on.
bool isModeOn(const std::vector<DrawnLeaf>& leaves, osg::StateAttribute::GLMode mode);

/// True if any of them is drawn by what stands there: blends, or has a logic operation.
bool readsBack(const std::vector<DrawnLeaf>& leaves);

/// Opens the channels that a mask leaves open; all without one. @return whether any is open.
bool openBy(const osg::ColorMask* mask, Channels& channels);

/// The colour channels that any of the leaves writes: fewer than all in anaglyph stereo, for one.
Channels writtenChannels(const std::vector<DrawnLeaf>& leaves);

/// Its drawable's name or that of the nearest named node above it, else its class.
std::string nameOf(const osgUtil::RenderLeaf& leaf);
/// The name of a node or of the nearest named one above it, by first parents; else its class name.
std::string nameOf(const osg::Node& node);

/// Drawn as filled triangles: points and lines are wider than what they are made of.
bool isFilled(const osgUtil::RenderLeaf& leaf);

/// Where on the screen a leaf of filled triangles can draw; nullopt if nowhere.
std::optional<ScreenRect> screenBoundsOf(const osgUtil::RenderLeaf& leaf);

/// Tells whether a leaf can draw in a part of the screen.
class TouchTest {
public:
    /// @param moved  leaves that a program moves, wherever; null: none. Must outlive this.
    explicit TouchTest(const ScreenRect& bounds, const LeafSet* moved = nullptr)
        : _bounds(bounds), _isAll(bounds.low == wholeScreen.low && bounds.high == wholeScreen.high), _moved(moved) {}
    /// True at least where the leaf's box may be seen in that part.
    bool operator()(const osgUtil::RenderLeaf& leaf);

private:
    const ScreenRect _bounds;
    const bool _isAll; ///< of the screen: whatever is drawn touches it.
    const LeafSet* const _moved;
    const osg::RefMatrix *_modelview = nullptr,
                         *_projection = nullptr; ///< of a leaf; those that follow mostly share them.
    ScreenSides _sides{};                        ///< of that part, for such a leaf.
};

} // namespace gnomon
