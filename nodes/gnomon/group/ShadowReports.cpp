// SPDX-License-Identifier: MIT
#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/NodeVisitor>

namespace gnomon {
namespace {

class Asker : public osg::NodeVisitor {
public:
    Asker() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Geode& geode) override {
        if (const auto* technique = dynamic_cast<const ShadowTechnique*>(&geode))
            reports.push_back(technique->lastReport());
    }
    std::vector<ShadowReport> reports;
};

} // namespace

std::vector<ShadowReport> shadowReports(osg::Node& scene) {
    Asker asker;
    scene.accept(asker);
    return asker.reports;
}

} // namespace gnomon
