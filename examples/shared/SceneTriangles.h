// SPDX-License-Identifier: MIT
#pragma once
#include <osg/AlphaFunc>
#include <osg/Drawable>
#include <osg/Image>
#include <osg/Node>
#include <osg/Texture2D>
#include <osg/Vec2d>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <optional>
#include <vector>

namespace gnomon::examples {

/// What an alpha test leaves of a textured surface; or, asked for, what blending leaves: all of an alpha of one half and more,
/// but of a surface with one alpha all over, as glass has, nothing if that is below one.
///
/// Limits  alpha is that of the 2D texture on unit 0 at full size, its image still in memory, and of what blends that of its
///         material or one colour, too; that of vertices counts as 1, texture matrices and combiners as none.
class Cutout {
public:
    /// Of the surface at the end of a path, its own state included; nullopt if no texel can be missing from it.
    static std::optional<Cutout> of(const osg::NodePath& path, const osg::Drawable& drawable);
    /// The same of a surface that blends, without a test; nullopt if it does not blend.
    static std::optional<Cutout> blended(const osg::NodePath& path, const osg::Drawable& drawable);

    /// Whether polygon modes let no side of a surface be filled: lines and points block no ray.
    static bool isUnfilled(const osg::NodePath& path, const osg::Drawable& drawable);

    /// Which alphas are there.
    const osg::AlphaFunc& test() const { return *_test; }
    /// Whether the surface is there. @param texcoord  of unit 0.
    bool keeps(const osg::Vec2d& texcoord) const;

private:
    Cutout(const osg::AlphaFunc& test, const osg::Texture2D* texture, double alpha = 1.0);
    bool isEven() const; ///< one alpha all over.
    double alphaOf(int column, int row) const;
    double alphaAt(const osg::Vec2d& texcoord) const;

    osg::ref_ptr<const osg::AlphaFunc> _test;
    osg::ref_ptr<const osg::Texture2D> _texture;
    osg::ref_ptr<const osg::Image> _image; ///< null: none.
    double _alpha;                         ///< besides the texture's.
};

/// A scene's triangles as its truth sees them: world, double, each with the object it is of. Shares no code with
/// VertexTraverser, which the techniques use, so that an error of one is seen by the other.
struct SceneTriangles {
    /// A drawable under one way down to it.
    struct Object {
        std::optional<Cutout> cutout;
        osg::NodePath path; ///< down to the drawable, which is its last.
    };

    std::vector<osg::Vec3d> vertices;
    std::vector<osg::Vec2d> texcoords; ///< of unit 0, a vertex each; (0, 0) where a drawable has none.
    std::vector<unsigned> indices;     ///< three a triangle.
    std::vector<unsigned> object;      ///< a triangle each: its place in `objects`.
    std::vector<Object> objects;

    std::size_t count() const { return object.size(); }
    /// Whether a triangle is there at weights u and v of its second and third corner.
    bool solidAt(unsigned triangle, double u, double v) const;
    bool hasCutouts() const;
    /// Scene's unit.
    double longestEdge(unsigned triangle) const;
};

/// What is in a scene besides what hides all behind it.
enum class Clear {
    HIDES, ///< what blends counts as solid.
    PASSES ///< texels that blend with an alpha below one half are not there, nor is glass.
};

/// What is switched on is taken, of an LOD its nearest range; other cameras' subgraphs, projections, text, points and
/// lines are not.
/// Limits  billboards stand as they are modelled, and what a vertex program moves stays.
SceneTriangles sceneTriangles(osg::Node& scene, Clear clear = Clear::HIDES);

} // namespace gnomon::examples
