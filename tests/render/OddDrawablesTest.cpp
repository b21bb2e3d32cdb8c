// SPDX-License-Identifier: MIT
// Casters and receivers whose arrays or bounds are not the usual ones. Each picture equals that of a usual drawable.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/Geometry>

#include <gtest/gtest.h>

using namespace test;

namespace {

const View view = perspective({-4.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 320, 240, 30.0);

/// The first of them.
osg::Geometry& geometryOf(osg::Node& node) { return *node.asGeode()->getDrawable(0)->asGeometry(); }

/// Bounds that nobody knows, as of a drawable that draws itself.
struct NoBounds : public osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
};

void takeBounds(osg::Node& node) {
    node.setCullingActive(false);
    geometryOf(node).setCullingActive(false);
    geometryOf(node).setComputeBoundingBoxCallback(new NoBounds);
    geometryOf(node).dirtyBound();
}

std::vector<osg::ref_ptr<gnomon::ShadowTechnique>> techniquesOn(osg::Node* ground) {
    osg::ref_ptr<gnomon::TerrainShadowGeode> hull = new gnomon::TerrainShadowGeode;
    hull->setReceiver({ground});
    return {planar(ground), new gnomon::ShadowMapTechnique, hull, new gnomon::TracedShadowTechnique,
            new gnomon::ShadowVolumeTechnique};
}

/// The pictures of all techniques. @param change  what is odd about the scene.
template <class Change>
std::vector<Picture> pictures(Change change) {
    std::vector<Picture> result;
    for (std::size_t i = 0; i < 5; ++i) {
        Scene scene = groundScene({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})});
        osg::Node& ground = *find(*scene.root, "ground");
        change(ground, *scene.content->getChild(scene.content->getNumChildren() - 1));
        scene.addShadow(techniquesOn(&ground)[i]);
        result.push_back(render(scene.root, view));
    }
    return result;
}

void expectSame(const std::vector<Picture>& pictures, const std::vector<Picture>& usual) {
    for (std::size_t i = 0; i < usual.size(); ++i)
        EXPECT_LE(pictures[i].different(usual[i]), i == 1 ? 50 : 0) // texels of maps lie elsewhere
            << "planar, map, hull, traced, volume: " << i;
}

} // namespace

TEST(OddDrawables, ABoxOfShortsCastsAsOneOfFloats) {
    const auto usual = pictures([](osg::Node&, osg::Node&) {});
    const auto shorts = pictures([](osg::Node&, osg::Node& caster) {
        osg::Geometry& geometry = geometryOf(caster);
        const auto& floats = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
        const osg::ref_ptr<osg::Vec3sArray> array = new osg::Vec3sArray;
        for (const osg::Vec3& v : floats) array->push_back(osg::Vec3s(GLshort(v.x()), GLshort(v.y()), GLshort(v.z())));
        geometry.setVertexArray(array);
        geometry.setInitialBound(osg::BoundingBox(-1, -1, 0, 1, 1, 2));
    });
    expectSame(shorts, usual);
}

TEST(OddDrawables, ACasterWithoutBoundsCastsAsOneWithThem) {
    expectSame(pictures([](osg::Node&, osg::Node& caster) { takeBounds(caster); }),
               pictures([](osg::Node&, osg::Node&) {}));
}

TEST(OddDrawables, AGroundWithoutBoundsReceivesAsOneWithThem) {
    expectSame(pictures([](osg::Node& ground, osg::Node&) { takeBounds(ground); }),
               pictures([](osg::Node&, osg::Node&) {}));
}
