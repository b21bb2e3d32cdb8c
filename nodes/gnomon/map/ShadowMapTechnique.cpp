// SPDX-License-Identifier: MIT
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/map/ProgramMaps.h>
#include <gnomon/map/ShadowMapCache.h>
#include <gnomon/mapfit/CascadeSplits.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr int leastSize = 16, mostSize = 16384;

constexpr double mostAngle = 20.0, mostLength = 1e6;

/// On a side of a texel, where it is widest. Soft: penumbras of a pixel or two are wider than the filter.
constexpr double pixels = 1.5, finePixels = 0.7, softPixels = 0.33;

std::string definesOf(ShadowMapTechnique::Filter filter) {
    constexpr const char* defines[] = {"#define NEAREST\n", "#define BILINEAR\n",
                                       "#define BICUBIC\n#define SAMPLES 4.0\n",
                                       "#define BICUBIC\n#define SAMPLES 16.0\n"};
    return defines[filter];
}

double within(double value, double most) { return value > 0.0 ? std::min(value, most) : 0.0; }

} // namespace

ShadowMapTechnique::ShadowMapTechnique() : _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _size(other._size),
      _filter(other._filter),
      _cascades(other._cascades),
      _edges(other._edges),
      _sunAngle(other._sunAngle),
      _lampSize(other._lampSize),
      _radius(other._radius),
      _view(other._view),
      _programUnit(other._programUnit),
      _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::~ShadowMapTechnique() = default;

void ShadowMapTechnique::setSize(int texels) { _size = std::clamp(texels, leastSize, mostSize); }

void ShadowMapTechnique::setCascades(int maps) { _cascades = std::clamp(maps, 0, mostCascades); }

void ShadowMapTechnique::setSunAngle(double degrees) { _sunAngle = within(degrees, mostAngle); }

void ShadowMapTechnique::setLampSize(double diameter) { _lampSize = within(diameter, mostLength); }

void ShadowMapTechnique::setRadius(double radius) { _radius = within(radius, mostLength); }

unsigned ShadowMapTechnique::passes() const { return _maps->resources().passes; }

std::vector<osg::ref_ptr<MarkJob>> ShadowMapTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                               const FrameCasters& casters) const {
    const osg::ref_ptr<const CasterLayers> drawn = _maps->castersOf(*view.group, casters.drawables());
    const auto usable = localLight(light.inGroup, drawn->origin);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    reportUnknownTests(view.frameNumber, casters.drawables());
    const std::optional<SpotCone> cone = spotOf(light);
    std::vector<osg::ref_ptr<MarkJob>> marks;
    if (cone && _programUnit < 0 && view.group->getComposite() == ShadowCasterGroup::RELIGHT)
        marks.emplace_back(_maps->around(view, *usable, *cone, *drawn));
    const osg::ref_ptr<MarkJob> mark = _maps->mark(view, light.number, *usable, cone, *drawn, wish());
    if (mark) marks.emplace_back(mark); // else out of sight: nothing to say
    return marks;
}

std::string ShadowMapTechnique::programFunction() const { return visibilityFunction(definesOf(_filter)); }

MapSettings ShadowMapTechnique::wish() const {
    MapSettings wish;
    wish.size = _size;
    wish.cascades = _cascades;
    wish.compare = _filter == NEAREST ? osg::Texture::NEAREST : osg::Texture::LINEAR;
    wish.defines = definesOf(_filter);
    wish.view = MapDebugView(_view);
    wish.unit = _programUnit;
    wish.smooth = _edges == SMOOTH && _filter != NEAREST;
    wish.pixels = _edges == SOFT ? softPixels : _edges == SMOOTH && _filter == FINE ? finePixels : pixels;
    if (_edges == SOFT) wish.soft = MapSoftness{std::tan(glm::radians(_sunAngle / 2.0)), _lampSize / 2.0, _radius};
    return wish;
}

void ShadowMapTechnique::reportUnknownTests(unsigned frame, const CasterDrawables& pieces) const {
    if (pieces.unknownTests == 0) return;
    report(frame, "alpha-tested drawables cast as if they were solid: " + std::to_string(pieces.unknownTests) +
                      ", the first in '" + pieces.unknownNode +
                      "'. Give them a 2D texture on unit 0, texture coordinates for each vertex, and no shader.");
}

void ShadowMapTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _maps->resizeGLObjectBuffers(maxSize);
}

void ShadowMapTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _maps->release(state);
}

} // namespace gnomon
