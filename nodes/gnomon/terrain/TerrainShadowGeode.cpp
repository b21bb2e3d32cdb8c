// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/MarkEdges.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ShadowProbe.h>
#include <gnomon/silhouette/StencilBatches.h>
#include <gnomon/terrain/HullTiles.h>
#include <gnomon/terrain/TerrainShadowCache.h>

#include <osg/Notify>
#include <osg/StateSet>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon {
namespace {

/// Marks of one light in one view: all that stands in a solid. What of that is ground is for the compositor to tell, which
/// cuts the marks to the receiver.
class TerrainMark : public Mark {
public:
    struct Tile {
        osg::ref_ptr<const TileShadows> shadows;
        glm::dvec4 light;   ///< as it is now, in the scene.
        bool endsAreUnseen; ///< by lines of sight to the ground.
    };
    std::vector<Tile> tiles;
    osg::ref_ptr<const osg::StateSet> program; ///< see shaderProgram().
    osg::ref_ptr<const MarkEdges> smooth;      ///< null: edges are hard.
    glm::dmat4 clipFromScene{1.0};             ///< see SceneFrame.
    osg::Matrixd sceneFromEye;
    bool testsBoxes = true; ///< boxTest() knows something.

    Kind kind() const override { return Kind::Counts; }
    std::string draw(ScreenPass& pass) const override;
    const MarkEdges* edges() const override { return smooth.get(); }
    void drawEdges(ScreenPass& pass) const override;
    BoxTest boxTest(const osg::Matrixd& eyeFromBox) const override;

protected:
    ~TerrainMark() override = default;
};

using Ranges = std::vector<VolumeGeometry::Range>;

/// Of layers, the ends of which are at these places. @param begin  of the first layer of all.
void append(const std::vector<unsigned>& ends, unsigned begin, const LayerSlice& slice, Ranges& ranges) {
    const unsigned first = slice.first > 0 ? ends[slice.first - 1] : begin,
                   count = ends[slice.first + slice.count - 1] - first;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == first)
        ranges.back().count += count;
    else
        ranges.push_back({first, count});
}

/// Solids go up and down far enough: what is beside them in plan is out of their reach.
Mark::BoxTest TerrainMark::boxTest(const osg::Matrixd& eyeFromBox) const {
    if (!testsBoxes) return {};
    return [this, toScene = eyeFromBox * sceneFromEye](const osg::BoundingBox& box) {
        const osg::Vec3d middle = osg::Vec3d(box.center()) * toScene,
                         half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
        glm::dvec2 reach(0.0);
        for (int row = 0; row < 3; ++row)
            reach += half[row] * glm::dvec2(std::abs(toScene(row, 0)), std::abs(toScene(row, 1)));
        const glm::dvec2 low = glm::dvec2(middle.x(), middle.y()) - reach, high = low + 2.0 * reach;
        return std::any_of(tiles.begin(), tiles.end(), [&](const Tile& tile) {
            const HullSolids& solids = tile.shadows->solids;
            return low.x <= solids.high.x && solids.low.x <= high.x && low.y <= solids.high.y && solids.low.y <= high.y;
        });
    };
}

/// One bit tells odd from even. From above, and from before all of a tile's solids, no line of sight to the ground meets their
/// ends, which are in the ground: then what is before it is counted, else what is behind it.
std::string TerrainMark::draw(ScreenPass& pass) const {
    osg::State& state = pass.state();
    const unsigned counters = pass.counters(), bit = pass.bit();
    std::vector<PrismLayers> layers;
    for (const Tile& tile : tiles) {
        const HullSolids& solids = tile.shadows->solids;
        layers.push_back(
            {glm::dvec2(solids.low), glm::dvec2(solids.high), unsigned(solids.sides.size()), solids.mostOver});
    }
    const auto rounds = stencilBatches(layers, counters & 1u ? counters : 1u);
    if (!counters && rounds.size() > 1) return noCounter;
    for (const std::vector<LayerSlice>& round : rounds) {
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        for (const LayerSlice& slice : round) {
            const Tile& tile = tiles[slice.tile];
            const HullSolids& solids = tile.shadows->solids;
            Ranges ranges;
            append(solids.sides, 0, slice, ranges);
            placeVolumes(state, clipFromScene, tile.light);
            if (tile.endsAreUnseen)
                pass.countEntered(counters ? counters : bit);
            else {
                append(solids.ends, solids.sides.back(), slice, ranges);
                pass.countHolding(counters ? counters : bit);
            }
            tile.shadows->geometry->draw(pass.renderInfo(), ranges);
        }
        glFrontFace(GL_CCW);
        state.apply();
        if (counters) pass.takeCount(counters, bit);
    }
    return "";
}

void TerrainMark::drawEdges(ScreenPass& pass) const {
    for (const Tile& tile : tiles) {
        placeVolumes(pass.state(), clipFromScene, tile.light);
        tile.shadows->geometry->draw(pass.renderInfo(), {{0, tile.shadows->solids.sides.back()}});
    }
}

} // namespace

TerrainShadowGeode::TerrainShadowGeode()
    : _program(shaderProgram("#define EXTRUDE\n")),
      _edges(new MarkEdges(MarkEdges::Of::Sides)),
      _cache(new TerrainShadowCache) {}

TerrainShadowGeode::TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _options(other._options),
      _program(shaderProgram("#define EXTRUDE\n")),
      _edges(new MarkEdges(MarkEdges::Of::Sides)),
      _cache(new TerrainShadowCache) {}

TerrainShadowGeode::~TerrainShadowGeode() = default;

void TerrainShadowGeode::setMethod(Method method) {
    const bool isKnown = method == BOX || method == HULL;
    _options.method = isKnown ? method : TerrainShadowOptions().method;
    if (!isKnown)
        OSG_WARN << "gnomon: " << describe()
                 << ": there is no method DRAPE any more, so hull takes its place. Use hull on "
                 << "terrain, or map or traced if other surfaces receive." << std::endl;
}

std::string TerrainShadowGeode::whyUnavailable() const {
    return getMethod() == BOX ? "" : whyMissing(OptionalPart::Terrain);
}

unsigned TerrainShadowGeode::builds() const { return _cache->found(); }

std::vector<osg::ref_ptr<Mark>> TerrainShadowGeode::prepare(const ViewFrame& view, const ShadowLight& light,
                                                            const Casters& casters) const {
    const auto refuse = [&](const std::string& cause) {
        report(view.frameNumber, cause);
        return std::vector<osg::ref_ptr<Mark>>();
    };
    if (!hasReceiver())
        return refuse("no terrain is named, so there is no shadow. Name it with setReceiver() (receiver=NAME).");
    const auto usable = lightInScene(light.inGroup, SceneFrame(osg::Vec3d()));
    if (!usable) return refuse("the light has no finite position or direction. Set the light's position.");
    const TerrainFrame frame = _cache->frame(view, casters, getReceiver(), {light.number, *usable}, getMethod() == BOX);
    for (const std::string& cause : frame.causes) report(view.frameNumber, cause);
    const TileView seen(view, frame.origin);
    osg::ref_ptr<TerrainMark> mark = new TerrainMark;
    mark->program = _program;
    if (getEdges() == SMOOTH) mark->smooth = _edges;
    mark->clipFromScene = seen.clipFromScene();
    mark->sceneFromEye = SceneFrame(frame.origin).sceneFromEye(view);
    mark->testsBoxes = view.options.skipsUntouched;
    for (const auto& shadows : frame.tiles) {
        const TileView::Shown shown = shadows ? seen.shown(shadows->solids) : TileView::Shown();
        if (!shown.bounds) continue;
        mark->screenBounds = mark->tiles.empty() ? *shown.bounds : united(mark->screenBounds, *shown.bounds);
        const bool follows = getMethod() == HULL && usable->w == 0.0;
        mark->tiles.push_back(
            {shadows, follows ? *usable : shadows->solids.light, frame.fromAbove && shown.isBeforeEye});
    }
    if (mark->tiles.empty()) return {}; // out of sight: nothing to say
    return {mark};
}

osg::ref_ptr<const osg::Referenced> TerrainShadowGeode::answersFor(const ShadowProbe& probe) const {
    if (!hasReceiver()) return nullptr;
    const glm::dvec4 light(glm::dvec3(probe.light) + probe.light.w * toGlm(probe.origin), probe.light.w);
    return _cache->answer(probe.group, *probe.group.casters(), getReceiver(), light, getMethod() == BOX);
}

bool TerrainShadowGeode::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    const auto* answer = static_cast<const TerrainAnswer*>(probe.answers.get());
    if (!answer) return true;
    const glm::dvec3 place = point + toGlm(probe.origin);
    const double near = 1e-5 * probe.casters.reach();
    const auto under = answer->drawn->ground->hit(place + glm::dvec3(0.0, 0.0, near), {0.0, 0.0, -1.0});
    return !under || place.z - under->z > near || !answer->holds(place);
}

void TerrainShadowGeode::letGo() const { _cache->letGo(); }

void TerrainShadowGeode::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _program->resizeGLObjectBuffers(maxSize);
    _edges->resizeGLObjectBuffers(maxSize);
    _cache->resizeGLObjectBuffers(maxSize);
}

void TerrainShadowGeode::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _program->releaseGLObjects(state);
    _edges->releaseGLObjects(state);
    _cache->releaseGLObjects(state);
}

} // namespace gnomon
