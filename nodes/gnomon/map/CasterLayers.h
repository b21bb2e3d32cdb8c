// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/map/CasterLayer.h>

#include <glm/vec3.hpp>

#include <unordered_map>

namespace gnomon {

/// What casts below a group in one revision as maps draw it, in two layers: what stands still, and what moves, so that the
/// first need be neither made nor drawn again where only the second changes. Never changed once made.
///
/// At first all stands still. What changes or comes moves from then on. Where something that stood still has changed or
/// gone, its layer is made anew, and what has come to rest since is put into it; so it is, too, once all that it would have
/// saved to do so earlier comes to as much as it costs.
///
/// Cost  of a change: a look at the list of pieces, and what moves; all, where the layer of what stands still is made anew.
struct CasterLayers : public osg::Referenced {
    /// Reads the graph as a cull traversal does: call it in the traversal that found the pieces.
    /// @param before  the answer before, of the same group; may be null.
    /// @return `before` itself for the same pieces.
    static osg::ref_ptr<const CasterLayers> of(const CasterDrawables& pieces,
                                               const osg::ref_ptr<const CasterLayers>& before);

    /// Where all of them are, standing still, and nothing to draw: for a MapForecast.
    static osg::ref_ptr<const CasterLayers> boxesOf(const CasterDrawables& pieces);

    const osg::ref_ptr<const CasterDrawables> pieces;
    osg::Vec3d origin;              ///< group frame; all positions are about it, and it stays where it is near.
    glm::dvec3 low{0.0}, high{0.0}; ///< bounds of all, about the origin.
    glm::dvec3 reach{0.0};          ///< half sides of a box about the origin that holds all.
    double widest = 0.0;            ///< diameter of a drawable.
    double rounding = 0.0;          ///< of the vertices by their own floats, of most.
    osg::ref_ptr<const CasterLayer> still, moving; ///< never null.

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~CasterLayers() override = default;

private:
    explicit CasterLayers(const CasterDrawables& given) : pieces(&given) {}
    void begin();
    void follow(const CasterLayers& before);
    void divideAnew(const CasterLayers& before);
    void measure();
    osg::Vec3d middle() const;
    bool isNear(const osg::Vec3d& place) const;
    bool isAtRest(const CasterDrawable* moving) const;

    unsigned _change = 0;                                       ///< which one this is.
    std::unordered_map<const CasterDrawable*, unsigned> _since; ///< of what moves, the change that it came with.
    std::size_t _wasted = 0; ///< triangles that were made again, though they were at rest.
};

} // namespace gnomon
