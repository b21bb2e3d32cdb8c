// SPDX-License-Identifier: MIT
#include <gnomon/TerrainGround.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/terrain/GroundRevision.h>

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/LOD>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// The terrain's drawables, and what they are made of.
class TerrainVisitor : public CasterVisitor {
public:
    explicit TerrainVisitor(const Selection& terrain) : CasterVisitor(terrain) { setLevels(Levels::All); }
    using CasterVisitor::apply;
    void apply(osg::LOD& lod) override {
        const unsigned before = _met;
        CasterVisitor::apply(lod);
        hasLevels = hasLevels || _met > before;
    }
    std::set<const osg::Drawable*> drawables;
    std::vector<osg::ref_ptr<const osg::Referenced>> sources;
    bool hasLevels = false;

protected:
    void applyCaster(osg::Drawable& drawable, const Casting&) override {
        ++_met;
        drawables.insert(&drawable);
        holdSources(drawable, sources);
    }

private:
    unsigned _met = 0;
};

bool isUnder(const osg::Node& node, const osg::Node& root) {
    if (&node == &root) return true;
    const auto& parents = node.getParents();
    return std::any_of(parents.begin(), parents.end(), [&](const osg::Group* up) { return isUnder(*up, root); });
}

/// Without the view's camera, or another that is drawn for itself.
osg::NodePath belowCamera(const osg::NodePath& path) {
    const auto isCamera = [](const osg::Node* node) { return dynamic_cast<const osg::Camera*>(node) != nullptr; };
    return {std::find_if(path.rbegin(), path.rend(), isCamera).base(), path.end()};
}

} // namespace

osg::ref_ptr<const GroundRevision> groundRevision(const osg::Node& group, const Selection& terrain,
                                                  const osg::ref_ptr<const GroundRevision>& known) {
    auto* root = const_cast<osg::Node*>(&group); // visitors ask for more than they need
    osg::Matrixd groundFromRoot;
    const auto roots = terrain.roots();
    if (!std::all_of(roots.begin(), roots.end(), [&](const auto& node) { return isUnder(*node, group); })) {
        const osg::NodePath path = belowCamera(group.getParentalNodePaths().front());
        root = path.front();
        groundFromRoot = osg::Matrixd::inverse(osg::computeLocalToWorld(path, false));
    }
    CasterFingerprint fingerprint(terrain);
    fingerprint.setLevels(CasterVisitor::Levels::All);
    fingerprint.setRootFromVisited(groundFromRoot);
    root->accept(fingerprint);
    if (known && known->revision == fingerprint.value()) return known;
    TerrainVisitor visitor(terrain);
    root->accept(visitor);
    osg::ref_ptr<GroundRevision> drawn = new GroundRevision;
    drawn->revision = fingerprint.value();
    drawn->drawables = std::move(visitor.drawables);
    drawn->sources = std::move(visitor.sources);
    drawn->hasLevels = visitor.hasLevels;
    drawn->ground = groundOf(*root, terrain, groundFromRoot);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    const auto all = drawn->ground->range(glm::dvec2(-everywhere), glm::dvec2(everywhere));
    drawn->steepest = all ? all->steepest : 0.0;
    return drawn;
}

} // namespace gnomon
