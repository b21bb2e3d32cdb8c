// SPDX-License-Identifier: MIT
#pragma once
#include "../scenes/ChartScene.h"

#include <gnomon/ShadowDecision.h>

#include <osg/Group>
#include <osg/Light>
#include <osg/MatrixTransform>

#include <string>
#include <vector>

namespace gnomon::examples {

/// What a scene is drawn for.
enum class Look {
    SHADED,    ///< as a user sees it: its own materials and textures, ambient light and the light.
    VISIBILITY ///< white, untextured, in the light alone: what the light does not reach is black.
};

/// Grey of the scene's ambient light and of the light's diffuse and specular in Look::SHADED; the light's own ambient is
/// none, as in gnomonshot --ambient.
constexpr float shadedAmbient = 0.3f, shadedDiffuse = 0.7f;

/// A scene set up with one contender's shadows, for one viewer: its root, and what may change between frames. The light
/// is its own, so that nothing a contender does to it reaches another.
class Staging {
public:
    virtual ~Staging() = default;
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;

    osg::Group& root() { return *_root; }
    /// The root, below or beside what the scene has around it.
    osg::ref_ptr<osg::Node> shown() { return _around ? _around(*_root) : osg::ref_ptr<osg::Node>(_root); }
    /// Colour behind the scene; black where black is full shadow.
    osg::Vec4 background() const;
    /// @param light  homogeneous, world.
    virtual void setLight(const osg::Vec4d& light);
    /// Takes the light's diffuse and specular away from everything, or gives them back.
    void setShining(bool shines);
    /// Empties the passes that cast, and only those: everything is drawn as before, by the same shaders.
    virtual void setCasting(bool casts) = 0;
    /// Why shadows were missing in the last frame, where the contender can say it.
    virtual std::vector<std::string> diagnose() const { return {}; }
    /// How each light's shadow was chosen in the last frame, where a technique chooses.
    virtual std::vector<ShadowDecision> decisions() const { return {}; }

protected:
    /// Makes the root with its light, and the content for this look: the scene's own, or a white copy.
    Staging(const ChartScene& scene, Look look);

    osg::ref_ptr<osg::Group> _root, _content;
    osg::ref_ptr<osg::Light> _light;

private:
    osg::ref_ptr<osg::MatrixTransform> _mount;
    osg::Vec3d _centre; ///< of the view: lamps point at it, for techniques that ask.
    Look _look;
    std::function<osg::ref_ptr<osg::Node>(osg::Node&)> _around;
};

/// A scene without shadows.
class PlainStaging : public Staging {
public:
    PlainStaging(const ChartScene& scene, Look look);
    void setCasting(bool) override {}
};

/// A copy of a subgraph with the shapes as they are drawn, and none of their looks: no materials, textures, programs or fog.
/// What is left is that without which other pixels would be drawn: culling, polygon offset and mode, clip planes, depth,
/// masks, restarts, and an alpha test or blending with its texture and material. Geometries without normals get smooth ones. Vertex arrays are shared with the original.
osg::ref_ptr<osg::Group> whiteCopy(const osg::Group& content);

} // namespace gnomon::examples
