// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MatrixUniform.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/CullableFaces.h>
#include <gnomon/geometry/ShadowReach.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Referenced>
#include <osg/State>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/ref_ptr>
#include <osgUtil/RenderLeaf>

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// In the scene, in floats, as what is drawn: what is flat is so whatever its transform makes of the last bits.
AlignedBox boxOf(const PlacedMesh& placed, const osg::Vec3d& origin);
bool isFlat(const AlignedBox& box); ///< along an axis of the group.
/// False if it is beyond a side of a map.
bool isInMap(const AlignedBox& box, const glm::dmat4& clipFromScene);

/// What one texture cuts out by one test, drawn in one call; see AlphaTest.
struct MapCutout {
    osg::ref_ptr<osg::Geometry> geometry; ///< positions, and coordinates of the texture: s, t and q.
    osg::ref_ptr<osg::Texture2D> texture;
    int passing = 0;
    float reference = 0.0f;
    bool flat = false;
};

/// The box of a caster, and the triangles in it.
struct MapPiece : AlignedBox {
    const PlacedMesh* placed = nullptr; ///< null where only the box is known.
    std::size_t first = 0, end = 0;     ///< corners of its mesh's triangles.
};

/// A mesh of casters as maps draw it, wherever it is.
struct MapMesh : public osg::Referenced {
    explicit MapMesh(const PlacedMesh& placed);

    const osg::ref_ptr<const CasterMesh> mesh; ///< held, so that its address cannot be taken by another.
    const bool isBody;
    std::vector<MapPiece> pieces;   ///< of what is joined, each drawable.
    std::vector<MapCutout> cutouts; ///< of these.

    /// Some of the triangles.
    struct Triangles {
        osg::ref_ptr<osg::DrawElementsUInt> corners; ///< may be empty.
        osg::ref_ptr<const CullableFaces> drawn{};   ///< null until they are asked for.
        bool solids = false;                         ///< what bounds solids is told apart.
    };
    Triangles all, unflat; ///< all that no texture cuts out; of it all but what is flat, as grounds are.

protected:
    ~MapMesh() override = default;
};

/// Meshes as maps draw them, as long as a MapLayer has them.
///
/// Threads
/// - One at a time. The owner locks.
class MapMeshes {
public:
    osg::ref_ptr<MapMesh> of(const PlacedMesh& placed);
    /// A picture begins, in which solids are looked for in some of those that move.
    void startPicture() { _searched = 0; }
    /// Null if there are none. What bounds solids is told apart where that saves time.
    /// @param flats   what is flat is drawn, too.
    /// @param again   it has been drawn before, and so may be drawn often.
    /// @param moving  its layer's bodies move on: they will be drawn often though the layer is not.
    osg::ref_ptr<const CullableFaces> trianglesOf(MapMesh& mesh, bool flats, bool again, bool moving);
    /// Lets go what nobody else has.
    void prune();
    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

private:
    template <class Act>
    void forAll(const Act& act) const;

    std::unordered_map<const CasterMesh*, osg::ref_ptr<MapMesh>> _known;
    std::size_t _searched = 0; ///< triangles, in this picture.
};

/// A layer of the casters as a light's map draws it. Never changed once made.
struct MapLayer : public osg::Referenced {
    /// @param known  null: where these are, and nothing to draw, for a MapForecast.
    explicit MapLayer(const CasterLayer& given, MapMeshes* known = nullptr);

    const osg::ref_ptr<const CasterLayer> casters;
    std::vector<osg::ref_ptr<MapMesh>> meshes; ///< as the casters have them.
    std::vector<MapPiece> unflats;             ///< the drawables, about the origin, the largest first,
    std::vector<MapPiece> flats;               ///< and those that are flat along an axis of the group.

    /// From a lamp about the origin to the nearest triangle; infinite if there is none. Triangles whose plane holds the lamp,
    /// to 10⁻⁶ of the coordinates, do not count: they cast nothing. Looks at the drawables that may be nearest.
    /// Of boxes alone the nearest box counts.
    double clearanceOf(const glm::dvec3& lamp) const;

protected:
    ~MapLayer() override = default;
};

/// A caster that draws itself, at its place in the scene.
struct SelfDrawnCaster {
    osg::ref_ptr<const SelfDrawing> drawing;
    glm::dmat4 sceneFromLocal{1.0};
    AlignedBox box; ///< scene.
};

/// What maps show of them, and the view whose frame they are drawn for. Programs find its modelview, and uniforms that
/// OpenSceneGraph gives views.
struct SelfDrawnCasters {
    SelfDrawnCasters() = default;
    SelfDrawnCasters(const std::vector<SelfDrawnCaster>& all, const glm::dmat4& eyeFromScene, const ViewFrame& view);

    std::vector<SelfDrawnCaster> casters;
    glm::dmat4 eyeFromScene{1.0}, eyeFromWorld{1.0};
    std::vector<osg::ref_ptr<const osg::StateSet>> states; ///< of the view, that belong to no node.
    std::vector<MatrixUniform> matrices;                   ///< of the group.

    /// True if they look as others do. What may change in each frame never does.
    bool areSame(const SelfDrawnCasters& other) const;
};

/// What casts below a group in one revision as maps draw it. Never changed once made.
struct MapCasters : public osg::Referenced {
    MapCasters(const Casters& casters, const osg::ref_ptr<const MapLayer>& standing,
               const osg::ref_ptr<const MapLayer>& others);

    const osg::ref_ptr<const Casters> of;
    const CasterLayers& layers;                       ///< of them.
    const osg::ref_ptr<const MapLayer> still, moving; ///< never null.
    const std::vector<SelfDrawnCaster> selfDrawn;     ///< those whose bounds are known; drawn with what moves.

    /// As MapLayer::clearanceOf(), of what moves; of what draws itself and has no known triangles the nearest box counts.
    double clearanceOfMoving(const glm::dvec3& lamp) const;

protected:
    ~MapCasters() override = default;
};

} // namespace gnomon
