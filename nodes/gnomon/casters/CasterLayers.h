// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterMesh.h>

#include <glm/vec3.hpp>
#include <osg/Referenced>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

namespace gnomon {

class CasterBodies;

/// Some of a group's casters as meshes. Never changed once made.
struct CasterLayer : public osg::Referenced {
    /// Reads the graph as a cull traversal does.
    /// @param origin  of the scene, group frame.
    /// @param before  layers whose joined meshes are taken where they would be the same; may be null.
    CasterLayer(CasterDrawables::List pieces, const osg::Vec3d& origin, CasterBodies& bodies,
                const std::vector<const CasterLayer*>& before);

    const CasterDrawables::List pieces; ///< In the order in which a traversal meets them.
    const osg::Vec3d origin;            ///< Of the scene, group frame.
    CasterDrawables::List loosePieces;  ///< Those that are no bodies.
    osg::ref_ptr<CasterMesh> loose;     ///< These, joined, in the scene; null if there are none.
    std::vector<PlacedMesh> meshes;     ///< The joined one, if there is one, and all bodies.
    std::size_t triangles = 0;          ///< Of all.

protected:
    ~CasterLayer() override = default;

private:
    void join(const std::vector<const CasterLayer*>& before);
};

/// The casters of a group as meshes, in one revision: in two layers, what stands still, and what moves, so that the first
/// need not be made again where only the second changes. Never changed once made. ShadowCasterGroup::casters() makes it.
///
/// Large drawables are bodies, each a mesh in its own frame; see CasterBodies. All others of a layer are joined in one mesh.
///
/// At first all stands still. What changes or comes moves from then on. Where something that stood still has changed or
/// gone, its layer is made anew, and what has come to rest since is put into it; so it is, too, once all that it would have
/// saved to do so earlier comes to as much as it costs.
///
/// Cost  of a change: a look at the list of pieces, and what moves; a body that moves costs a matrix. All that is joined
/// is made anew where one of it starts to move.
/// Threads
/// - Any number.
struct CasterLayers : public osg::Referenced {
    /// Reads the graph as a cull traversal does: call it in the traversal that found the pieces.
    /// @param before  the answer before, of the same group; may be null.
    /// @param bodies  gets those that are met.
    /// @return `before` itself for the same pieces.
    static osg::ref_ptr<const CasterLayers> of(const CasterDrawables& pieces,
                                               const osg::ref_ptr<const CasterLayers>& before, CasterBodies& bodies);

    /// True if there is no triangle.
    bool empty() const { return pieces->empty(); }
    /// Those of both layers.
    std::vector<PlacedMesh> meshes() const;
    /// Number of triangles of both layers.
    std::size_t triangles() const { return still->triangles + moving->triangles; }
    /// Stands for these in a cache, which then keeps no caster. True once no view will ask for them any more.
    using Retired = std::shared_ptr<const std::atomic<bool>>;
    Retired retired() const { return _retired; }
    /// No view will ask for these any more: caches may let them go.
    void retire() const { *_retired = true; }
    bool isRetired() const { return *_retired; }

    const osg::ref_ptr<const CasterDrawables> pieces;
    osg::Vec3d origin;              ///< group frame; all positions are about it, and it stays where it is near.
    osg::BoundingBoxd bounds;       ///< of all, group frame; invalid without any.
    glm::dvec3 low{0.0}, high{0.0}; ///< bounds of all, about the origin.
    glm::dvec3 reach{0.0};          ///< half sides of a box about the origin that holds all.
    double widest = 0.0;            ///< diameter of a drawable. These count casters that draw themselves, too.
    double widestBody = 0.0;        ///< the same without what is flat and level along two axes.
    double rounding = 0.0;          ///< of the vertices by their own floats, of most.
    double largestRounding = 0.0;   ///< see CasterExtraction::getRounding().
    osg::ref_ptr<const CasterLayer> still, moving; ///< never null.

protected:
    ~CasterLayers() override = default;

private:
    explicit CasterLayers(const CasterDrawables& given) : pieces(&given) {}
    void begin(CasterBodies& bodies);
    void follow(const CasterLayers& before, CasterBodies& bodies);
    void divideAnew(const CasterLayers& before, CasterBodies& bodies);
    void measure();
    osg::Vec3d middle() const;
    bool isNear(const osg::Vec3d& place) const;
    bool isAtRest(const CasterDrawable* moving) const;

    unsigned _change = 0;                                       ///< which one this is.
    std::unordered_map<const CasterDrawable*, unsigned> _since; ///< of what moves, the change that it came with.
    std::size_t _wasted = 0; ///< triangles that were made again, though they were at rest.
    const std::shared_ptr<std::atomic<bool>> _retired = std::make_shared<std::atomic<bool>>(false);
};

} // namespace gnomon
