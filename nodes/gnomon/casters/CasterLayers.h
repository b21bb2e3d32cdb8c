// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/CasterMesh.h>

#include <glm/vec3.hpp>
#include <osg/BoundingBox>
#include <osg/Referenced>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace gnomon {

class Casters;
class KnownCasters;

/// Some of a group's casters as meshes. Never changed once made.
struct CasterLayer : public osg::Referenced {
    /// Reads the graph as a cull traversal does.
    /// @param origin  of the scene, group frame.
    /// @param before  layers whose joined meshes are taken where they would be the same; may be null.
    CasterLayer(CasterList pieces, const osg::Vec3d& origin, KnownCasters& known,
                const std::vector<const CasterLayer*>& before);

    const CasterList pieces;        ///< In the order in which a traversal meets them.
    const osg::Vec3d origin;        ///< Of the scene, group frame.
    CasterList loosePieces;         ///< Those that are no bodies.
    osg::ref_ptr<CasterMesh> loose; ///< These, joined, in the scene; null if there are none.
    std::vector<PlacedMesh> meshes; ///< The joined one, if there is one, and all bodies.
    std::size_t triangles = 0;      ///< Of all.

protected:
    ~CasterLayer() override = default;

private:
    void join(const std::vector<const CasterLayer*>& before);
};

/// Casters as meshes: in two layers, what stands still, and what moves, so that the first need not be made again where only
/// the second changes. Never changed once made. Casters::layers() makes it.
///
/// Large drawables are bodies, each a mesh in its own frame; see isBody(). All others of a layer are joined in one mesh.
///
/// At first all stands still. What changes or comes moves from then on. Where something that stood still has changed or
/// gone, its layer is made anew, and what has come to rest since is put into it; so it is, too, once all that it would have
/// saved to do so earlier comes to as much as it costs.
///
/// Cost  of a change: a look at the list of pieces, and what moves; a body that moves costs a matrix. All that is joined
/// is made anew where one of it starts to move.
/// Threads
/// - Any number.
class CasterLayers {
public:
    /// Reads the graph as a cull traversal does.
    /// @param casters  whose they are, and which they are part of.
    /// @param before   those of the same group before; may be null.
    /// @param known    gets the bodies that are met.
    CasterLayers(const Casters& casters, const CasterLayers* before, KnownCasters& known);

    /// Those of both layers.
    std::vector<PlacedMesh> meshes() const;
    /// Number of triangles of both layers.
    std::size_t triangles() const { return still->triangles + moving->triangles; }

    osg::Vec3d origin;              ///< group frame; all positions are about it, and it stays where it is near.
    osg::BoundingBoxd bounds;       ///< of all, group frame; invalid without any.
    glm::dvec3 low{0.0}, high{0.0}; ///< bounds of all, about the origin.
    glm::dvec3 reach{0.0};          ///< half sides of a box about the origin that holds all.
    double widest = 0.0;            ///< diameter of a drawable. These count casters that draw themselves, too.
    double widestUnflat = 0.0;      ///< the same without what is flat and level along two axes.
    double rounding = 0.0;          ///< of the vertices by their own floats, of most.
    double largestRounding = 0.0;   ///< see CasterExtraction::getRounding().
    osg::ref_ptr<const CasterLayer> still, moving; ///< never null.

private:
    void begin(KnownCasters& known);
    void follow(const CasterLayers& before, KnownCasters& known);
    void divideAnew(const CasterLayers& before, KnownCasters& known);
    void measure();
    osg::Vec3d middle() const;
    bool isNear(const osg::Vec3d& place) const;
    bool isAtRest(const Caster* moving) const;

    const Casters& _casters;
    unsigned _change = 0;                               ///< which one this is.
    std::unordered_map<const Caster*, unsigned> _since; ///< of what moves, the change that it came with.
    std::size_t _wasted = 0;                            ///< triangles that were made again, though they were at rest.
};

} // namespace gnomon
