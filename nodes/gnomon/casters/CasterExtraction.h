// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterVisitor.h>

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

        void reset() override;

    /// All of them finite, and within the range of float.
    const std::vector<osg::Vec3d>& getVertices() const { return _vertices; }
    /// Three indices into getVertices() a triangle, counter-clockwise seen from the side that was the front in the
    /// drawable's own frame, mirrored or not. Triangles of no area are kept, unless two of their indices are equal.
    const std::vector<unsigned>& getTriangles() const { return _triangles; }

    /// A drawable that was met, and where its triangles begin in getTriangles(); they end where the next one's begin.
    struct Drawn {
        const osg::Drawable* drawable; ///< to be told apart from others only: it may be gone.
        std::size_t first;
    };
    const std::vector<Drawn>& getDrawn() const { return _drawn; }

    /// One of them that an alpha test leaves parts of.
    struct Cutout {
        std::size_t drawn;                  ///< its place in getDrawn().
        AlphaTest test;                     ///< which has a texture.
        unsigned firstVertex;               ///< in getVertices(), where all of its own follow one another.
        std::vector<osg::Vec3> coordinates; ///< of the texture, of each of its vertices.
    };
    const std::vector<Cutout>& getCutouts() const { return _cutouts; }
    /// Drawables that an alpha test leaves parts of which are not known here.
    unsigned getUnknownTests() const { return _unknownTests; }
    /// As getInvalidNode(), of the first of them.
    const std::string& getUnknownNode() const { return _unknownNode; }

    /// Largest error that storing a vertex as float in its own array can have made, in the root's unit; 0 for doubles.
    double getRounding() const { return _rounding; }
    /// Triangles left out: a corner is not finite, or beyond the range of float, or its index is out of the array.
    unsigned getInvalidTriangles() const { return _invalidTriangles; }
    /// The nearest name on the way up from the first drawable that has such a triangle; its class if none has a name.
    const std::string& getInvalidNode() const { return _invalidNode; }

    /// Arrays and primitive sets that were read. While they are held, nothing new can take their addresses: a
    /// CasterFingerprint compared with an earlier value relies on it.
    const std::vector<osg::ref_ptr<const osg::Referenced>>& getSources() const { return _sources; }

protected:
    void applyCaster(osg::Drawable& drawable) override;

private:
    class Collector;
    /// Where a vertex of the current array went: its place in _vertices, if `array` is the current one's number.
    struct Slot {
        unsigned array = 0;
        unsigned place = 0;
    };
    /// Its place in _cutouts; null if no test leaves parts of it.
    Cutout* startCutout(const osg::Drawable& drawable);
    std::string nameHere(const osg::Drawable& drawable) const;

    std::vector<osg::Vec3d> _vertices;
    std::vector<unsigned> _triangles;
    std::vector<osg::ref_ptr<const osg::Referenced>> _sources;
    std::vector<Drawn> _drawn;
    std::vector<Cutout> _cutouts;
    std::vector<Slot> _slots;
    unsigned _array = 0;
    double _rounding = 0.0;
    unsigned _invalidTriangles = 0;
    std::string _invalidNode;
    unsigned _unknownTests = 0;
    std::string _unknownNode;
};

} // namespace gnomon
