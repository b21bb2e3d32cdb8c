// SPDX-License-Identifier: MIT
#include <gnomon/TerrainGround.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/terrain/GroundRevision.h>

#include <glm/geometric.hpp>
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

bool GroundRevision::isAsSteepAs(const glm::dvec3& towardsSun, double share) const {
    return !(steepest * glm::length(glm::dvec2(towardsSun)) < share * towardsSun.z);
}

TerrainPlace TerrainPlace::inFrameOf(const osg::Node& group, const Selection& terrain) {
    const auto root = const_cast<osg::Node*>(&group); // visitors ask for more than they need
    const auto roots = terrain.roots();
    if (std::all_of(roots.begin(), roots.end(), [&](const auto& node) { return isUnder(*node, group); }))
        return {*root, terrain, osg::Matrixd::identity()};
    const osg::NodePath path = belowCamera(group.getParentalNodePaths().front());
    return {*path.front(), terrain, osg::Matrixd::inverse(osg::computeLocalToWorld(path, false))};
}

std::uint64_t TerrainPlace::revision() const {
    CasterFingerprint revision(terrain);
    revision.setLevels(CasterVisitor::Levels::All);
    revision.setRootFromVisited(groundFromRoot);
    root.accept(revision);
    return revision.value();
}

osg::ref_ptr<const GroundRevision> TerrainPlace::drawn(const osg::ref_ptr<const GroundRevision>& known) const {
    const std::uint64_t now = revision();
    if (known && known->revision == now) return known;
    TerrainVisitor visitor(terrain);
    root.accept(visitor);
    osg::ref_ptr<GroundRevision> drawn = new GroundRevision;
    drawn->revision = now;
    drawn->drawables = std::move(visitor.drawables);
    drawn->sources = std::move(visitor.sources);
    drawn->hasLevels = visitor.hasLevels;
    drawn->ground = groundOf(root, terrain, groundFromRoot);
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    const auto all = drawn->ground->range(glm::dvec2(-everywhere), glm::dvec2(everywhere));
    drawn->steepest = all ? all->steepest : 0.0;
    return drawn;
}

} // namespace gnomon
