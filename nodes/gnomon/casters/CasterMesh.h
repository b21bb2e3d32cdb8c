// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterExtraction.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/PrimitiveSet>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <typeindex>
#include <typeinfo>
#include <vector>

namespace gnomon {

/// Casters as one triangle mesh: one that moves as a whole, in its own frame, or others joined in the group's. What techniques
/// derive of the triangles is found once for all, and goes with the mesh.
///
/// CasterLayers has all meshes of a group, and where they are. Use Casters to treat each drawable apart.
///
/// Cost
/// - 12 bytes a triangle, and 12 bytes a vertex that a triangle uses, 16 more where anything is smooth; and what is derived.
/// Limits
/// - VertexTraverser lists what is left out.
/// Threads
/// - Any number. A mesh never changes, and a frame that is still drawn keeps its own.
class CasterMesh : public osg::Referenced {
public:
    /// Copies the extracted triangles.
    /// @param about  the mesh's origin. Default: in the midst of most corners.
    explicit CasterMesh(const CasterExtraction& casters, const std::optional<osg::Vec3d>& about = {});

    /// True if there is no triangle.
    bool empty() const { return triangles->empty(); }

    osg::Vec3d origin;                             ///< Frame of the extraction. The vertices are relative to it.
    osg::ref_ptr<osg::Vec3Array> vertices;         ///< Relative to `origin`. All are finite and used by a triangle.
    osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< Three indices a triangle; see CasterExtraction::getTriangles().
    osg::ref_ptr<osg::Vec4Array>
        offsets;              ///< See terminatorOffsets(), one a vertex. Null if all cast from where they are.
    osg::BoundingBoxd bounds; ///< Bounds of the triangles, frame of the extraction. Invalid without triangles.
    double rounding = 0.0;    ///< Largest error of a vertex by its float source.
    std::vector<CasterExtraction::Drawn> drawn;    ///< Drawables of the triangles. `first` indexes `triangles`.
    std::vector<CasterExtraction::Cutout> cutouts; ///< Drawables with clear parts. `firstVertex` indexes `vertices`.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< See CasterExtraction::getSources().

    /// What is derived of the triangles, one of each type: made by whoever asks first, while others who ask for it wait.
    /// @param make  makes it, as a shared pointer. It may use several threads, but must not ask for the same type.
    template <class T, class Make>
    std::shared_ptr<const T> derived(const Make& make) const {
        return std::static_pointer_cast<const T>(derived(typeid(T), make, true));
    }
    /// The same, but let go as soon as nobody holds it: for what is large and used by few.
    template <class T, class Make>
    std::shared_ptr<const T> lent(const Make& make) const {
        return std::static_pointer_cast<const T>(derived(typeid(T), make, false));
    }

    /// What is derived, if it is there; null otherwise.
    template <class T>
    std::shared_ptr<const T> known() const {
        return std::static_pointer_cast<const T>(derived(typeid(T), nullptr, false));
    }

protected:
    ~CasterMesh() override = default;

private:
    struct Slot {
        OpenThreads::Mutex mutex;         ///< held while it is made.
        std::weak_ptr<const void> made;   ///< as long as anyone has it,
        std::shared_ptr<const void> kept; ///< such as the mesh.
    };
    std::shared_ptr<const void> derived(const std::type_info& type,
                                        const std::function<std::shared_ptr<const void>()>& make, bool keep) const;

    mutable OpenThreads::Mutex _mutex; ///< of the list of slots alone.
    mutable std::map<std::type_index, Slot> _slots;
};

/// The mesh's vertices as the maths takes them, as many as `vertices` has.
inline const glm::vec3* positionsOf(const CasterMesh& mesh) {
    static_assert(sizeof(glm::vec3) == sizeof(osg::Vec3));
    return static_cast<const glm::vec3*>(mesh.vertices->getDataPointer());
}
/// Its offsets; null if there are none.
inline const glm::vec4* offsetsOf(const CasterMesh& mesh) {
    static_assert(sizeof(glm::vec4) == sizeof(osg::Vec4));
    return mesh.offsets ? static_cast<const glm::vec4*>(mesh.offsets->getDataPointer()) : nullptr;
}

/// Makes a drawable of some triangles of a mesh. It has positions only, and shares the mesh's buffers.
osg::ref_ptr<osg::Geometry> casterGeometry(const CasterMesh& mesh, osg::DrawElementsUInt* triangles);

/// A mesh of casters at a place. Scene: the group's axes about the origin of its CasterLayers.
///
/// A body keeps its mesh while it moves, and shares it with all bodies of the same geometry. Keep what you derive of the
/// triangles by the mesh, and take lights and planes into its frame.
struct PlacedMesh {
    osg::ref_ptr<const CasterMesh> mesh;
    glm::dmat4 sceneFromMesh{1.0}; ///< Affine and invertible, from the mesh's vertices. Identity for what is no body.
    bool isBody = false;           ///< It moves as a whole.
    bool mirrored = false;         ///< What is counter-clockwise in the mesh is clockwise in the scene.
    double stretched = 1.0;        ///< The most by which sceneFromMesh lengthens anything.
    double rounding = 0.0;         ///< Largest error of a vertex by its float source, group's unit.
    Hiding hiding = Hiding::Both;  ///< Of a body; what is joined has its own for each drawable.
    osg::BoundingBoxd bounds;      ///< Of its triangles, group frame.
    bool selfDrawn = false;        ///< A body that maps draw by its own state: see Caster.
};

} // namespace gnomon
