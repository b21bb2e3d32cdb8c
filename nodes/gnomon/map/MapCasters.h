// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawable.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CullableFaces.h>

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
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon {

/// Triangles of a mesh as maps draw them.
struct DrawnFaces {
    osg::ref_ptr<const CasterMesh> mesh; ///< held, so that its address cannot be taken by another.
    osg::ref_ptr<osg::DrawElementsUInt> triangles;
    osg::ref_ptr<const CullableFaces> faces; ///< null until they are asked for.
    bool knowsSolids = false;

    /// @param solids  what bounds solids is told apart.
    const osg::ref_ptr<const CullableFaces>& get(bool solids);
};

/// Bodies as maps draw them, wherever they are: one a geometry. See CasterBodies.
///
/// Threads
/// - One at a time. The owner locks.
class MapBodies {
public:
    /// A picture begins, in which solids are looked for in some of those that move.
    void startPicture() { _searched = 0; }
    /// @param again   its solids are told apart.
    /// @param moving  so are those of one that has been drawn before, if too many were not searched already.
    osg::ref_ptr<const CullableFaces> of(const CasterMesh& mesh, bool again, bool moving);
    /// Lets go what nobody else draws.
    void prune();
    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

private:
    std::unordered_map<const CasterMesh*, DrawnFaces> _known;
    std::size_t _searched = 0; ///< triangles, in this picture.
};

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
        Box box;                          ///< in the scene.
        CullableFaces::Outside outside{}; ///< where the light is.

        bool operator==(const Drawn& other) const {
            return faces == other.faces && sceneFromMesh == other.sceneFromMesh && outside == other.outside;
        }
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

    const bool _boxesOnly = false;
    std::shared_ptr<Joined> _joined; ///< of the joined mesh; null if there is none.
};

/// False if a box of the scene is beyond a side of a map.
bool isInMap(const MapLayer::Box& box, const glm::dmat4& clipFromScene);

/// A caster that draws itself, at its place in the scene.
struct OwnCaster {
    osg::ref_ptr<const OwnDrawing> drawing;
    glm::dmat4 sceneFromLocal{1.0};
    MapLayer::Box box; ///< scene.
};
/// Those whose bounds are known.
std::vector<OwnCaster> ownCastersOf(const CasterLayers& layers);
/// From a lamp in the scene to the nearest box of those without known triangles; infinite if there is none.
double clearanceOf(const std::vector<OwnCaster>& casters, const glm::dvec3& lamp);

/// The view whose frame they are drawn for. Programs find its modelview, and uniforms that OpenSceneGraph gives views.
struct OwnView {
    /// @param seen  leaves of the view.
    OwnView(const glm::dmat4& eyeFromScene, const std::vector<const osgUtil::RenderLeaf*>& seen);
    OwnView() = default;

    glm::dmat4 eyeFromScene{1.0};
    std::vector<osg::ref_ptr<const osg::StateSet>> states; ///< that belong to no node.
};

/// What maps show of them.
struct OwnCasters {
    std::vector<OwnCaster> casters;
    OwnView view;

    /// True if they look as others do. What may change in each frame never does.
    bool areSame(const OwnCasters& other) const;
};

/// What casts below a group in one revision as maps draw it. Never changed once made.
struct MapCasters : public osg::Referenced {
    MapCasters(const CasterLayers& casters, osg::ref_ptr<const MapLayer> standing, osg::ref_ptr<const MapLayer> others)
        : layers(&casters), still(std::move(standing)), moving(std::move(others)), own(ownCastersOf(casters)) {}

    const osg::ref_ptr<const CasterLayers> layers;
    const osg::ref_ptr<const MapLayer> still, moving; ///< never null.
    const std::vector<OwnCaster> own;                 ///< drawn with what moves.

    void resizeGLObjectBuffers(unsigned maxSize) const {
        for (const auto& layer : {still, moving}) layer->resizeGLObjectBuffers(maxSize);
    }
    void releaseGLObjects(osg::State* state) const {
        for (const auto& layer : {still, moving}) layer->releaseGLObjects(state);
    }

protected:
    ~MapCasters() override = default;
};

} // namespace gnomon
