// SPDX-License-Identifier: MIT
#include "Contender.h"
#include "ChartResults.h"
#include "SceneSetup.h"

#include <gnomon/NamedNode.h>
#include <gnomon/ShadowSpec.h>

#include <osg/LightModel>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// A scene under one of Gnomon's techniques. In Look::VISIBILITY composite=blend darkens to black.
class GnomonStaging : public Staging {
public:
    /// @throws std::invalid_argument, one sentence, if the specification does not suit the scene.
    GnomonStaging(ShadowSpec spec, const ChartScene& scene, Look look)
        : Staging(scene, look), _group(new ShadowCasterGroup) {
        if (look == Look::VISIBILITY && spec.composite == ShadowCasterGroup::BLEND) {
            spec.dark = 0.0f;
            osg::ref_ptr<osg::LightModel> model =
                new osg::LightModel; // or what is turned away is black, shadowed or not
            model->setAmbientIntensity({0.25f, 0.25f, 0.25f, 1.0f});
            _root->getOrCreateStateSet()->setAttributeAndModes(model);
        }
        _group->addChild(_content);
        _root->addChild(_group);
        _techniques = addShadows(*_group, {spec});
        GnomonStaging::diagnose(); // who asks is not warned by osg::notify() besides
        GnomonStaging::setLight(scene.light);
    }

    void setLight(const osg::Vec4d& light) override {
        Staging::setLight(light);
        _group->setLights({{0, light}});
    }
    void setCasting(bool casts) override {
        Selection all;
        if (!casts) all.mask = 0;
        _group->setCasters(all);
    }
    std::vector<std::string> diagnose() const override { return diagnoses(_techniques); }
    std::vector<ShadowDecision> decisions() const override { return _techniques.front()->lastDecision(); }

private:
    osg::ref_ptr<ShadowCasterGroup> _group;
    std::vector<osg::ref_ptr<ShadowTechnique>> _techniques;
};

constexpr osg::Node::NodeMask casts = 0x1, receiveMask = 0x2;

/// A camera of the technique's own that draws casters: no view has it, and it is not the one by which DrawBounds
/// techniques look at receivers.
bool isCastPass(osgUtil::CullVisitor& visitor) {
    const osg::Camera* camera = visitor.getCurrentCamera();
    return camera && !camera->getView() && camera->getName() != "AnalysisCamera";
}

/// Lets everything cast but the receiver, and the receiver alone receive; the way down to it lets both through.
class SplitMasks : public osg::NodeVisitor {
public:
    explicit SplitMasks(const std::string& receiver) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _receiver(receiver) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        const bool found = !_found && node.getName() == _receiver;
        if (found) _found = true;
        const bool foundBefore = _found;
        if (!found) traverse(node);
        const bool above = _found && !foundBefore;
        if (node.getNodeMask() != 0) node.setNodeMask(found ? receiveMask : above ? casts | receiveMask : casts);
    }

    bool found() const { return _found; }

private:
    std::string _receiver;
    bool _found = false;
};

osg::ref_ptr<osg::Group> splitCopy(const osg::Group& content, const std::string& receiver) {
    osg::ref_ptr<osg::Group> copy = osg::clone(&content, osg::CopyOp(osg::CopyOp::DEEP_COPY_NODES));
    SplitMasks split(receiver);
    if (!receiver.empty()) copy->accept(split);
    if (!split.found())
        throw std::invalid_argument("ShadowTexture needs a receiver that does not cast, but the scene names none.");
    return copy;
}

/// A scene under one of osgShadow's techniques.
///
/// Casting off  a cull callback keeps the content out of every camera that draws a shadow map, in Look::VISIBILITY only.
///              Bounds are asked of all of it as before, so that maps lie where they lay. (An empty cast mask would do
///              more: ViewDependentShadowMap's crop degenerates.)
/// ParallelSplit  is given the light by setUserLight(), as its documentation asks: it reads no position. A lamp's light
///              comes from the lamp through the scene's centre.
/// ShadowTexture  needs receivers that do not cast: what ChartScene::receiver names receives, all else casts.
class PeerStaging : public Staging {
public:
    /// @throws std::invalid_argument, one sentence, if the scene does not suit the peer or a setting is unknown.
    PeerStaging(const Peer& peer, const Settings& settings, const ChartScene& scene, Look look) : Staging(scene, look) {
        const PeerParts parts = makePeer(peer, settings, scene.radius);
        osg::ref_ptr<osgShadow::ShadowedScene> shadowed = new osgShadow::ShadowedScene(parts.technique);
        if (!peer.partsCastAndReceive) {
            _content = splitCopy(*_content, scene.receiver);
            parts.settings->setCastsShadowTraversalMask(casts);
            parts.settings->setReceivesShadowTraversalMask(receiveMask);
        }
        shadowed->setShadowSettings(parts.settings.get());
        if (auto* splits = dynamic_cast<osgShadow::ParallelSplitShadowMap*>(parts.technique.get()))
            splits->setUserLight(_light);
        if (look == Look::VISIBILITY) {
            if (!peer.lightOnly.empty()) setAmbientBias(*parts.technique, peer.lightOnly);
            _gate = new Gate;
            osg::ref_ptr<osg::Group> gated = new osg::Group;
            gated->addChild(_content);
            gated->setCullCallback(_gate);
            shadowed->addChild(gated);
        } else {
            shadowed->addChild(_content);
        }
        _root->addChild(shadowed);
    }

    void setCasting(bool on) override {
        if (_gate) _gate->open = on;
    }

private:
    struct Gate : osg::NodeCallback {
        void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
            osgUtil::CullVisitor* cull = visitor->asCullVisitor();
            if (open || !cull || !isCastPass(*cull)) traverse(node, visitor);
        }
        bool open = true;
    };

    osg::ref_ptr<Gate> _gate;
};

struct GnomonPoint {
    const char* technique;
    const char* setting;
    const char* spec; ///< see gnomon::ShadowSpec.
    Receives receives = Receives::EVERYTHING;
};

constexpr GnomonPoint gnomonPoints[] = {
    {"planar", "relight", "planar", Receives::FLAT},
    {"planar", "blend", "planar:composite=blend", Receives::FLAT},
    {"planar, smooth", "relight", "planar:edges=smooth", Receives::FLAT},
    {"planar, smooth", "blend", "planar:edges=smooth,composite=blend", Receives::FLAT},
    {"box", "relight", "box", Receives::TERRAIN},
    {"hull", "relight", "hull", Receives::TERRAIN},
    {"hull", "blend", "hull:composite=blend", Receives::TERRAIN},
    {"hull, smooth", "relight", "hull:edges=smooth", Receives::TERRAIN},
    {"hull, smooth", "blend", "hull:edges=smooth,composite=blend", Receives::TERRAIN},
    {"map", "size 512", "map:size=512"},
    {"map", "size 1024", "map"},
    {"map", "size 2048", "map:size=2048"},
    {"map", "bilinear, size 1024", "map:filter=bilinear"},
    {"map", "nearest, size 1024", "map:filter=nearest"},
    {"map", "blend, nearest, size 256, one map", "map:filter=nearest,composite=blend,size=256,cascades=1"},
    {"map", "blend, nearest, size 512, one map", "map:filter=nearest,composite=blend,size=512,cascades=1"},
    {"map", "blend, nearest, size 1024, one map", "map:filter=nearest,composite=blend,cascades=1"},
    {"map", "blend, nearest, size 512", "map:filter=nearest,composite=blend,size=512"},
    {"map", "blend, nearest, size 1024", "map:filter=nearest,composite=blend"},
    {"map", "blend, size 512", "map:composite=blend,size=512"},
    {"map", "blend, size 1024", "map:composite=blend"},
    {"map", "blend, size 2048", "map:composite=blend,size=2048"},
    {"map, smooth", "relight", "map:edges=smooth"},
    {"map, smooth", "blend, size 512", "map:edges=smooth,composite=blend,size=512"},
    {"map, smooth", "blend", "map:edges=smooth,composite=blend"},
    {"map, smooth", "blend, size 1536", "map:edges=smooth,composite=blend,size=1536"},
    {"map, smooth", "blend, size 2048", "map:edges=smooth,composite=blend,size=2048"},
    {"map, smooth", "blend, fine", "map:edges=smooth,composite=blend,filter=fine,size=4096"},
    {"map, smooth", "blend, bilinear", "map:edges=smooth,composite=blend,filter=bilinear"},
    {"map, smooth", "blend, bilinear, size 512", "map:edges=smooth,composite=blend,filter=bilinear,size=512"},
    {"map, soft", "size 1024", "map:edges=soft"},
    {"map, soft", "size 2048", "map:edges=soft,size=2048"},
    {"map, soft", "blend, size 1024", "map:edges=soft,composite=blend"},
    {"map, soft", "blend, size 2048", "map:edges=soft,composite=blend,size=2048"},
    {"volume", "relight", "volume"},
    {"volume", "blend", "volume:composite=blend"},
    {"volume, smooth", "relight", "volume:edges=smooth"},
    {"volume, smooth", "blend", "volume:edges=smooth,composite=blend"},
    {"auto", "error 4", "auto:error=4"},
    {"auto", "error 1", "auto"},
    {"auto", "error 0.4", "auto:error=0.4"},
    {"auto", "blend, error 4", "auto:error=4,composite=blend"},
    {"auto", "blend, error 1", "auto:composite=blend"},
    {"auto", "blend, error 0.4", "auto:error=0.4,composite=blend"},
    {"traced", "relight", "traced"},
    {"traced", "blend", "traced:composite=blend"},
    {"traced, smooth", "relight", "traced:edges=smooth"},
    {"traced, smooth", "blend", "traced:edges=smooth,composite=blend"},
};

/// Beside the defaults: the most accurate setting of each technique in the chart of 16 scenes, the faster one of settings that are
/// alike to a hundredth of a pixel. And two that docs/evidence/performance.md advises.
constexpr const char* briefSpecs[] = {
    "planar:composite=blend",
    "hull:composite=blend",
    "map:edges=smooth,composite=blend",
    "map:edges=smooth,composite=blend,filter=fine,size=4096",
    "volume:composite=blend",
    "auto:composite=blend",
    "auto:error=0.4,composite=blend",
    "traced:composite=blend",
    "volume:edges=smooth,composite=blend",
    "traced:edges=smooth,composite=blend",
    "planar:edges=smooth,composite=blend",
    "hull:edges=smooth,composite=blend",
};

/// Variants of osgShadow's classes that were neither faster nor more accurate in that chart than one of the same class.
constexpr const char* likeOthers[] = {"Minimal", "MinimalCullBounds", "LightSpacePerspective DB",
                                      "ViewDependent ortho x2", "ViewDependent perspective x2"};

/// @param spec  of a point.
bool isBrief(const std::string& spec) {
    return spec.find(':') == std::string::npos ||
           std::find(std::begin(briefSpecs), std::end(briefSpecs), spec) != std::end(briefSpecs);
}

ShadowSpec specFor(const std::string& text, Receives receives, const ChartScene& scene) {
    ShadowSpec spec = parseShadowSpec(text);
    if (receives == Receives::EVERYTHING) return spec;
    const bool flat = receives == Receives::FLAT;
    spec.receiver = flat ? scene.receiver : scene.terrain;
    if (spec.receiver.empty())
        throw std::invalid_argument(spec.technique + " needs a " + (flat ? "flat receiver" : "terrain") +
                                    ", but the scene names none.");
    return spec;
}

} // namespace

Contender plainContender() {
    Contender result{"", "none", "", {}, {}};
    result.stage = [](const ChartScene& scene, Look look) { return std::make_unique<PlainStaging>(scene, look); };
    return result;
}

std::vector<Contender> gnomonContenders() {
    std::vector<Contender> result;
    for (const GnomonPoint& point : gnomonPoints) {
        result.push_back(gnomonContender(point.spec, point.receives));
        result.back().technique = point.technique;
        result.back().setting = point.setting;
        result.back().isBrief = isBrief(point.spec);
    }
    return result;
}

Contender gnomonContender(const std::string& spec, Receives receives) {
    Contender result{ourKit, "", "", {{"--shadow", spec}}, {}};
    result.receives = receives;
    result.stage = [spec, receives](const ChartScene& scene, Look look) {
        return std::make_unique<GnomonStaging>(specFor(spec, receives, scene), scene, look);
    };
    return result;
}

std::vector<std::string> chartTechniques() {
    std::vector<std::string> names;
    for (const GnomonPoint& point : gnomonPoints)
        if (names.empty() || names.back() != point.technique) names.emplace_back(point.technique);
    for (const Peer& peer : peers()) names.push_back(peer.name);
    return names;
}

Contender peerContender(const Peer& peer, const std::string& setting, const Settings& settings) {
    Contender result{"osgShadow", peer.name, setting, settings, {}};
    if (!peer.partsCastAndReceive) result.receives = Receives::FLAT;
    result.isBrief = std::find(std::begin(likeOthers), std::end(likeOthers), peer.name) == std::end(likeOthers);
    result.stage = [&peer, settings](const ChartScene& scene, Look look) {
        return std::make_unique<PeerStaging>(peer, settings, scene, look);
    };
    return result;
}

std::vector<Entrant> entrants(const std::vector<std::string>& parts, bool best, bool brief) {
    const auto holds = [](const std::string& technique, const std::string& part) {
        return technique.find(part) != std::string::npos;
    };
    const std::vector<std::string> names = chartTechniques();
    for (const std::string& part : parts)
        if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return holds(name, part); }))
            throw std::invalid_argument("no technique's name contains \"" + part + "\". See --list.");
    const auto isAsked = [&](const std::string& name) {
        return parts.empty() ||
               std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return holds(name, part); });
    };
    std::vector<Entrant> result;
    for (Contender& contender : gnomonContenders())
        if (isAsked(contender.technique) && (contender.isBrief || !brief)) result.push_back({std::move(contender)});
    for (const Peer& peer : peers()) {
        if (!isAsked(peer.name)) continue;
        Contender plain = peerContender(peer, "defaults", {});
        if (brief && !plain.isBrief) continue;
        result.push_back({std::move(plain)});
        if (best && !peer.knobs.empty()) result.push_back({peerContender(peer, "best", {}), &peer});
    }
    return result;
}

} // namespace gnomon::examples
