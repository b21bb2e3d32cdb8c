// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/FrameCopies.h>
#include <gnomon/map/DepthMap.h>
#include <gnomon/mapfit/MapFit.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <osg/StateSet>
#include <osg/Viewport>

#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// What a ShadowMapTechnique's marks share: they belong to it, so that they are released with its other OpenGL objects.
class MapPrograms : public osg::Referenced {
public:
    MapPrograms();

    const osg::ref_ptr<osg::StateSet> casterProgram, casterByLampProgram, cutoutProgram, blocksProgram, coneProgram;
    FrameDepthCopy seen;
    std::atomic<unsigned> passes{0}; ///< maps drawn so far.

    /// The program for these defines, see map.frag, or of the debug view, see map_view.frag; made at its first use.
    osg::ref_ptr<const osg::StateSet> program(const std::string& defines, bool debugView = false);
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~MapPrograms() override = default;

private:
    std::vector<osg::ref_ptr<osg::StateSet>> all();

    OpenThreads::Mutex _mutex;
    std::map<std::pair<bool, std::string>, osg::ref_ptr<osg::StateSet>> _programs; ///< by what they are for.
};

/// One map of a light, as pixels look it up.
struct MapLookUp {
    glm::dmat4 mapFromScene{1.0}; ///< see MapFit; the scene is about the casters' origin.
    MapErrors errors;
    MapSpread spread;
};

/// How pixels of one view find what share of one light reaches them: by what the depth buffer says is seen there, and the
/// light's maps.
struct MapLookupPass {
    osg::ref_ptr<MapPrograms> resources;
    osg::ref_ptr<DepthMap> map;
    osg::ref_ptr<const MapPicture> picture;
    std::vector<MapLookUp> lookUps;          ///< one a tile of the picture.
    std::vector<glm::dvec2> outline;         ///< of where less than all of the light can arrive: see drawPolygon().
    glm::dmat4 clipFromScene{1.0};           ///< as drawn.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.
    double rounding = 0.0;                   ///< of the vertices that are drawn, see DrawnError.
    std::optional<glm::dmat4> coneFromScene; ///< of a spot: what is not in its cone gets no fragments.
    ShadowMapOptions::Filter filter = ShadowMapOptions::BICUBIC;
    bool cascades = false; ///< the finer of them hold part of what is seen only.
    bool smooth = false;   ///< edges are a pixel wide.
    bool soft = false;     ///< wider than the filter, see MapSpread.
    bool penumbra = false; ///< and as wide as what blocks the light is far away.

    /// True if pixels may have a part of the light.
    bool fades() const { return smooth || soft; }

    /// Which fragments are drawn, and what they hold.
    struct Wanted {
        double below;  ///< those of pixels that less than this share of the light reaches.
        bool blocked;  ///< alpha is the share that does not arrive, else that which does.
        double factor; ///< colour of a pixel that none of it reaches; all: 1.
    };
    /// Draws them; draws the map first, if that is due. The pass's stencil test, blending and colour mask stand.
    /// @return why that is not possible, or not as it should be, as a cause for ShadowTechnique::report(); empty if all is
    ///         well.
    std::string draw(ScreenPass& pass, const Wanted& wanted) const;
    /// Makes the map show its picture, unless it does.
    /// @return as draw().
    std::string showMap(osg::RenderInfo& renderInfo) const;
    /// Of map_place.frag.
    std::string mapDefines() const;
    /// Those and the frame's depths, for map_place.frag.
    void setConstants(osg::State& state, const FrameDepthCopy::Copy& copy, const Wanted& wanted,
                      const PixelRect& pixels) const;
    std::vector<glm::dvec4> places() const;
    /// Of those nearest or farthest, as map.frag has them.
    std::vector<glm::dvec4> errors(MapError MapErrors::*which) const;

private:
    std::string definesOf(const PixelRect& pixels, bool wide) const;
    void drawFragments(osg::State& state, ScreenPass& pass) const;
    void drawWide(osg::State& state, ScreenPass& pass) const;
    /// How many vectors map_place.frag has there.
    std::size_t sharedConstants() const;
    std::size_t constantsOfMap() const;
    std::size_t flatConstants(std::size_t all) const;
    glm::dvec4 drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const;
    void addMap(std::size_t map, const glm::dmat4& mapFromPixel, std::vector<glm::dvec4>& constants) const;
};

/// Draws over a picture how a light's maps lie; of texels and cascades those of the first light alone.
/// @param before  how many lights have been drawn.
void drawMapView(const MapLookupPass& quad, ShadowMapOptions::View view, ScreenPass& pass, int before);

/// Marks of one light in one view: where the light's maps hold something nearer to it than what is seen.
class MapMark : public Mark {
public:
    MapLookupPass quad;
    ShadowMapOptions::View view = ShadowMapOptions::NOTHING;

    Kind kind() const override { return quad.fades() ? Kind::Fades : Kind::Hard; }
    std::string draw(ScreenPass& pass) const override;
    bool canDarken() const override { return true; }
    bool hasView() const override { return view != ShadowMapOptions::NOTHING; }
    void drawView(ScreenPass& pass, int before) const override { drawMapView(quad, view, pass, before); }

protected:
    ~MapMark() override = default;
};

/// Marks of one spot in one view: what of all that is seen is not in its cone.
class SpotMark : public Mark {
public:
    osg::ref_ptr<MapPrograms> resources;
    glm::dmat4 clipFromScene{1.0}; ///< as drawn.
    glm::dmat4 coneFromScene{1.0}; ///< see gnomon::coneFromScene().

    std::string draw(ScreenPass& pass) const override;
    bool relightsOnly() const override { return true; }

protected:
    ~SpotMark() override = default;
};

/// A light's maps, as programs of a view's drawables find them: see visibility.glsl.
class ProgramMaps : public ProgramMark {
public:
    /// Of no maps: all of the light arrives. @param unit  of textures.
    explicit ProgramMaps(unsigned unit);
    ProgramMaps(const MapLookupPass& quad, const glm::dmat4& sceneFromEye, unsigned unit);

    std::string drawAhead(osg::RenderInfo& renderInfo) const override;

protected:
    ~ProgramMaps() override = default;

private:
    std::optional<MapLookupPass> _quad;
};

/// The function that looks them up: GLSL 1.30.
std::string visibilityFunction(ShadowMapOptions::Filter filter);

} // namespace gnomon
