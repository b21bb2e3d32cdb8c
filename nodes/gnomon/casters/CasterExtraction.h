// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterVisitor.h>

#include <glm/vec4.hpp>
#include <osg/Referenced>
#include <osg/Vec3>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace gnomon {

/// The triangles of all casters below a node, in the frame that the node stands in, in double; see VertexTraverser, which
/// is its public side.
///
/// Cost    one pass over the vertices; 24 bytes a vertex, 12 a triangle, and 8 a vertex of the largest array.
class CasterExtraction : public CasterVisitor {
public:
    explicit CasterExtraction(const Selection& selection = {});
    ~CasterExtraction() override = default;
    META_NodeVisitor(gnomon, CasterExtraction)

    /// Forgets all results, for another traversal.
    void reset() override;
    /// Adds what another traversal found, in the same frame.
    void append(const CasterExtraction& other);
    /// Lets go what only another traversal would need: this one is to be kept.
    void trim();

    /// The vertices. All are finite and within the range of float. Triangles of one drawable share them.
    const std::vector<osg::Vec3d>& getVertices() const { return _vertices; }
    /// The triangles: three indices each into getVertices(), counter-clockwise as seen from the drawable's front side.
    /// A mirroring transform keeps the front side. Triangles of no area are kept unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const { return _triangles; }

    /// A drawable that the traversal read. Its triangles end at the next drawable's first.
    struct Drawn {
        const osg::Drawable* drawable; ///< Identifies the drawable. Do not dereference it: the drawable may be gone.
        std::size_t first;             ///< Index of its first corner in getTriangles().
        Hiding hiding;                 ///< What it hides.
    };
    /// See terminatorOffsets(): as many as vertices; none if there are none at all.
    const std::vector<glm::vec4>& getOffsets() const { return _offsets; }
    /// The drawables, in traversal order.
    const std::vector<Drawn>& getDrawn() const { return _drawn; }

    /// A drawable with triangles that are clear in part, such as leaves or a fence. Those that are all clear are left out.
    struct Cutout {
        std::size_t drawn;    ///< Its index in getDrawn().
        bool selfDrawn;       ///< Only its own drawing tells what is clear: it has no test or coordinates.
        AlphaTest test;       ///< The test. AlphaTest::isSampled().
        unsigned firstVertex; ///< Index of its first vertex in getVertices(). Its others follow.
        std::vector<osg::Vec3> coordinates; ///< Texture coordinates (s, t, q), one for each of its vertices.
    };
    /// Those drawables, in traversal order.
    const std::vector<Cutout>& getCutouts() const { return _cutouts; }
    /// Name of the first of them, found as for getInvalidNode().
    const std::string& getCutoutNode() const { return _cutoutNode; }
    /// Number of triangles left out because they are all clear.
    std::size_t getClearTriangles() const { return _clearTriangles; }

    /// Largest error from storing a vertex as float in its own array, in the root's unit. 0 for double arrays.
    double getRounding() const { return _rounding; }
    /// Number of triangles left out because a corner is not finite, beyond the range of float, or not in the array.
    unsigned getInvalidTriangles() const { return _invalidTriangles; }
    /// Name of the first drawable with an invalid triangle: its own, or that of the nearest named node above it.
    /// Its class name if none of them has a name.
    const std::string& getInvalidNode() const { return _invalidNode; }

    /// The arrays and primitive sets that were read. Hold them to keep their addresses from being used again.
    const std::vector<osg::ref_ptr<const osg::Referenced>>& getSources() const { return _sources; }

protected:
    void applyCaster(osg::Drawable& drawable, const Casting& casting) override;

private:
    class Collector;
    void addOffsets(const Collector& of, std::size_t firstVertex, std::size_t firstCorner);
    /// Where a vertex of the current array went: its place in _vertices, if `array` is the current one's number.
    struct Slot {
        unsigned array = 0;
        unsigned place = 0;
    };
    std::string nameHere(const osg::Drawable& drawable) const;

    std::vector<osg::Vec3d> _vertices;
    std::vector<unsigned> _triangles;
    std::vector<glm::vec4> _offsets;
    std::vector<osg::ref_ptr<const osg::Referenced>> _sources;
    std::vector<Drawn> _drawn;
    std::vector<Cutout> _cutouts;
    std::vector<Slot> _slots;
    unsigned _array = 0;
    double _rounding = 0.0;
    unsigned _invalidTriangles = 0;
    std::string _invalidNode;
    std::string _cutoutNode;
    std::size_t _clearTriangles = 0;
};

} // namespace gnomon
