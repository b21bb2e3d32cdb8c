// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawable.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/map/MapLayer.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <osg/GL>
#include <osg/Referenced>
#include <osg/RenderInfo>
#include <osg/State>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <osgUtil/RenderLeaf>

#include <vector>

namespace gnomon {

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

/// Draws casters by their own code into maps, under a MapState.
///
/// Cost  what they cost in the view, for each map that holds them.
class OwnCasterPass {
public:
    OwnCasterPass(osg::RenderInfo& renderInfo, const OwnCasters& own, double slopeOffset)
        : _renderInfo(renderInfo), _own(own), _slopeOffset(slopeOffset) {}

    /// A part of a texture, and where the scene stands in it.
    struct Target {
        glm::ivec2 corner;
        int size; ///< texels.
        PixelRect texels;
        glm::dmat4 clipFromScene;
        double nearest; ///< see MapPicture::Tile.
    };
    void draw(const std::vector<Target>& targets) const;

private:
    void draw(const OwnCaster& caster, const std::vector<Target>& targets) const;
    void draw(const OwnCaster& caster, const Target& target) const;
    void clip(const OwnCaster& caster, const glm::dmat4& clipFromEye, double nearest) const;

    osg::RenderInfo& _renderInfo;
    const OwnCasters& _own;
    const double _slopeOffset;
};

/// OpenGL as a map is drawn under; put back at its end.
class MapState {
public:
    explicit MapState(double slopeOffset) {
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT | GL_SCISSOR_BIT |
                     GL_STENCIL_BUFFER_BIT);
        for (const GLenum mode : {GL_STENCIL_TEST, GL_CULL_FACE}) glDisable(mode);
        for (GLenum plane = GL_CLIP_PLANE0; plane <= GL_CLIP_PLANE5; ++plane) glDisable(plane);
        for (const GLenum mode :
             {GLenum(GL_SCISSOR_TEST), GLenum(GL_DEPTH_TEST), depthClamp, GLenum(GL_POLYGON_OFFSET_FILL)})
            glEnable(mode);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glClearDepth(1.0);
        glPolygonOffset(static_cast<GLfloat>(slopeOffset), 0.0f);
    }
    ~MapState() { glPopAttrib(); }
    MapState(const MapState&) = delete;
    MapState& operator=(const MapState&) = delete;
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
