// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/TracedCasters.h>
#include <gnomon/TracedMark.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/UsableLight.h>

#include <glm/gtc/matrix_transform.hpp>
#include <osg/io_utils>

#include <optional>
#include <sstream>
#include <stdexcept>

namespace gnomon {
namespace {

/// The casters' box and everything behind it as the light sees it: each corner, and where its shadow goes.
std::optional<ScreenRect> boundsOf(const CasterMesh& mesh, const TracedMark& mark) {
    std::vector<glm::dvec4> points;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = toGlm(mesh.bounds.corner(i) - mesh.origin), light(mark.light);
        points.push_back(mark.clipFromScene * glm::dvec4(corner, 1.0));
        points.push_back(mark.clipFromScene * glm::dvec4(mark.light.w == 0.0 ? -light : corner - light, 0.0));
    }
    return screenBounds(points);
}

} // namespace

TracedShadowTechnique::TracedShadowTechnique() : _casters(new TracedCasters), _resolved(new ResolvedDepth) {}

TracedShadowTechnique::TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _casters(new TracedCasters), _resolved(new ResolvedDepth) {}

TracedShadowTechnique::~TracedShadowTechnique() = default;

std::vector<osg::ref_ptr<MarkJob>> TracedShadowTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                                  const CasterMesh& mesh) const {
    const auto usable = usableLight(light.inGroup, mesh.origin);
    if (!usable) {
        std::ostringstream cause;
        cause << "cannot use the light at (" << light.inGroup << "), which is nowhere: set the light's position.";
        report(view.frameNumber, cause.str());
        return {};
    }
    osg::ref_ptr<TracedMark> mark = new TracedMark;
    mark->light = *usable;
    mark->resolved = _resolved;
    mark->clipFromScene = glm::translate(toGlm(view.eyeFromGroup * view.projection), toGlm(mesh.origin));
    const auto bounds = boundsOf(mesh, *mark);
    if (!bounds) return {}; // out of sight: nothing to say
    mark->screenBounds = *bounds;
    try {
        mark->scene = _casters->of(mesh, describe());
    } catch (const std::exception& failure) {
        report(view.frameNumber, std::string("casts no shadow: ") + failure.what());
        return {};
    }
    return {mark};
}

unsigned TracedShadowTechnique::builds() const { return _casters->builds(); }

void TracedShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _resolved->release(state);
}

} // namespace gnomon
