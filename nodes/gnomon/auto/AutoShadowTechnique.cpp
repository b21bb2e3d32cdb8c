// SPDX-License-Identifier: MIT
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/auto/AutoChooser.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/group/SceneFrame.h>

#include <osg/GraphicsContext>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace gnomon {
namespace {

/// The causes that another technique has for one frame, without its name.
std::vector<std::string> causesOf(const ShadowTechnique& technique) {
    const std::string start = technique.describe() + ": ";
    std::vector<std::string> causes = technique.diagnose();
    for (std::string& cause : causes)
        if (cause.rfind(start, 0) == 0) cause.erase(0, start.size());
    return causes;
}

} // namespace

AutoShadowOptions AutoShadowOptions::usable() const {
    AutoShadowOptions options;
    if (error > 0.0) options.error = std::clamp(error, leastError, mostError);
    return options;
}

AutoShadowTechnique::AutoShadowTechnique() : _chooser(new AutoChooser) {}

AutoShadowTechnique::AutoShadowTechnique(const AutoShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _chooser(new AutoChooser) {}

AutoShadowTechnique::~AutoShadowTechnique() = default;

void AutoShadowTechnique::setError(double pixels) { setOptions({pixels}); }

std::vector<ShadowDecision> AutoShadowTechnique::lastDecision() const { return _chooser->lastDecision(); }

unsigned AutoShadowTechnique::passes() const { return _chooser->passes(); }

std::vector<osg::ref_ptr<Mark>> AutoShadowTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                             const Casters& casters) const {
    const auto usable = lightInScene(light.inGroup, SceneFrame(osg::Vec3d()));
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const AutoChooser::Drawn drawn = _chooser->choose({view, light, casters, *usable}, getReceiver(), _options);
    if (!drawn.cause.empty()) report(view.frameNumber, drawn.cause);
    if (!drawn.technique) return {};
    drawn.technique->beginFrame(view.frameNumber, view.frameTime, view.key.stage);
    std::vector<osg::ref_ptr<Mark>> marks = drawn.technique->prepare(view, light, casters);
    for (const std::string& cause : causesOf(*drawn.technique)) report(view.frameNumber, cause);
    return marks;
}

/// The first frame's choice knows who draws where the context is current in cull.
void AutoShadowTechnique::traverse(osg::NodeVisitor& visitor) {
    const osgUtil::CullVisitor* cull = visitor.asCullVisitor();
    const osg::State* state = cull ? cull->getState() : nullptr;
    if (cull) _chooser->beginCull(state && state->getGraphicsContext() && state->getGraphicsContext()->isCurrent());
    ShadowTechnique::traverse(visitor);
}

void AutoShadowTechnique::letGo() const {
    _chooser->forEach([](ShadowTechnique& inner) { inner.letGo(); });
    _chooser->forgetFacts();
}

osg::ref_ptr<DrawWatch> AutoShadowTechnique::watch(const ViewFrame&) const { return _chooser->watch(); }

void AutoShadowTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _chooser->forEach([maxSize](ShadowTechnique& inner) { inner.resizeGLObjectBuffers(maxSize); });
}

void AutoShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _chooser->forEach([state](ShadowTechnique& inner) { inner.releaseGLObjects(state); });
}

} // namespace gnomon
