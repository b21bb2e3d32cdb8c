// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CullableFaces.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/State>
#include <osg/Texture2D>
#include <osg/ref_ptr>

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// Bodies as maps draw them, wherever they are: one a geometry. See CasterBodies.
///
/// Threads
/// - One at a time. The owner locks.
class MapBodies {
public:
    /// A picture begins, in which solids are looked for in some of those that move.
    void startPicture() { _searched = 0; }
    /// All faces, or the solids of one that moves and has been drawn before.
    osg::ref_ptr<const CullableFaces> of(const CasterMesh& mesh, bool moving);
    /// The faces with solids told apart.
    osg::ref_ptr<const CullableFaces> solidsOf(const CasterMesh& mesh);
    /// Lets go what nobody else draws.
    void prune();
    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh;             // held, so that its address cannot be taken by another
        osg::ref_ptr<const CullableFaces> whole, solids; ///< null until they are asked for.
    };

    std::unordered_map<const CasterMesh*, Entry> _known;
    std::size_t _searched = 0; ///< triangles, in this picture.
};

class MapBodies;

/// A layer of the casters as a light's map draws it. Never changed once made.
struct MapLayer : public osg::Referenced {
    struct Box {
        glm::dvec3 low, high;
    };

    /// Those that one texture cuts out by one test, drawn in one call; see AlphaTest.
    struct Cutout {
        osg::ref_ptr<osg::Geometry> geometry; ///< positions, and coordinates of the texture: s, t and q.
        osg::ref_ptr<osg::Texture2D> texture;
        int passing = 0;
        float reference = 0.0f;
        bool flat = false;
    };

    /// A mesh, or some of its triangles, at a place.
    struct Drawn {
        osg::ref_ptr<const CullableFaces> faces;
        glm::dmat4 sceneFromMesh{1.0};
        Box box; ///< in the scene.
    };

    /// @param before  layers, whatever of which is the same is taken.
    MapLayer(const CasterLayer& casters, const std::vector<osg::ref_ptr<const MapLayer>>& before);

    /// Where these are, and nothing to draw: for a MapForecast.
    static osg::ref_ptr<const MapLayer> boxesOf(const CasterLayer& casters);

    const osg::ref_ptr<const CasterLayer> casters;
    std::vector<Cutout> cutouts; ///< what textures cut out.
    std::vector<Box> bodyBoxes;  ///< of the drawables, about the origin, the largest first.
    std::vector<Box> flatBoxes;  ///< of those that are flat along an axis of the group.

    /// All that no texture cuts out, or of it all but what is flat, as grounds are. One thread at a time.
    /// @param again   it has been drawn before, and so may be drawn often: its solids are told apart.
    /// @param moving  its bodies move on: they will be drawn often though the layer is not.
    std::vector<Drawn> faces(bool flats, bool again, bool moving, MapBodies& bodies) const;

    /// From a lamp about the origin to the nearest triangle; infinite if there is none. Triangles whose plane holds the lamp,
    /// to 10⁻⁶ of the coordinates, do not count: they cast nothing. Looks at the drawables that may be nearest.
    /// Of boxes alone the nearest box counts.
    double clearanceOf(const glm::dvec3& lamp) const;

    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

protected:
    ~MapLayer() override = default;

private:
    explicit MapLayer(const CasterLayer& given) : casters(&given), _boxesOnly(true) {}
    struct Joined;
    struct Part;
    std::vector<Part> parts() const;

    const bool _boxesOnly = false;
    std::shared_ptr<Joined> _joined; ///< of the joined mesh; null if there is none.
};

/// False if a box of the scene is beyond a side of a map.
bool isInMap(const MapLayer::Box& box, const glm::dmat4& clipFromScene);

} // namespace gnomon
