// SPDX-License-Identifier: MIT
// Scene files keep the settings of each technique, and its picture.
#include "SceneFile.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

namespace {

using test::childOf;
using test::SceneFile;

/// @param from  height of its lower face.
test::Scene boxOverGround(double from) {
    return test::groundScene({test::box({-1.0, -1.0, from}, {1.0, 1.0, 2.0})}, 8.0, {1.0, 0.3, 1.0, 0.0});
}

TEST_P(SceneFile, DrawsTheSameTracedPictureOnceLoaded) {
    test::Scene scene = boxOverGround(0.5);
    const osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    technique->setReceiver({test::find(*scene.content, "ground")});
    scene.addShadow(technique);
    expectSamePictureOnceLoaded(scene);
}

TEST_P(SceneFile, DrawsTheSameMappedPictureOnceLoaded) {
    test::Scene scene = boxOverGround(0.5);
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    technique->setSize(20); // so that its own size and filter show
    technique->setFilter(gnomon::ShadowMapTechnique::FINE);
    scene.addShadow(technique);
    expectSamePictureOnceLoaded(scene);
}

TEST_P(SceneFile, DrawsTheSamePicturesOnTerrainOnceLoaded) {
    for (const auto method : {gnomon::TerrainShadowGeode::HULL, gnomon::TerrainShadowGeode::BOX}) {
        test::Scene scene = boxOverGround(0.0);
        const osg::ref_ptr<gnomon::TerrainShadowGeode> technique = new gnomon::TerrainShadowGeode;
        technique->setMethod(method);
        technique->setReceiver({test::find(*scene.content, "ground")});
        scene.addShadow(technique);
        expectSamePictureOnceLoaded(scene);
    }
}

TEST_P(SceneFile, DrawsTheSameAutomaticPictureOnceLoaded) {
    test::Scene scene = boxOverGround(0.5);
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    technique->setError(0.2);
    scene.addShadow(technique);
    expectSamePictureOnceLoaded(scene);
}

TEST_P(SceneFile, DrawsTheSameMirrorAndHaloOnceLoaded) {
    test::Scene scene = test::groundScene({test::box({2.0, 2.0, 0.5}, {3.0, 3.0, 2.0})}, 8.0, {1.0, 0.3, 1.0, 0.0});
    const osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
    halo->addChild(test::node(test::box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0}), "ringed"));
    halo->setScale(1.3);
    const osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
    mirror->addChild(test::node(test::box({-4.0, 0.0, 0.5}, {-3.0, 1.0, 2.0}), "mirrored"));
    mirror->setSurface({test::find(*scene.content, "ground")});
    mirror->setReflectance({0.9f, 0.5f, 0.1f});
    scene.content->addChild(halo);
    scene.content->addChild(mirror);
    scene.addShadow(test::planar(test::find(*scene.content, "ground")));
    expectSamePictureOnceLoaded(scene);
    const test::View view = test::perspective({-6.0, -8.0, 8.0}, {0.0, 0.0, 0.0});
    const test::Picture both = test::render(scene.root, view);
    mirror->setSurface({});
    const test::Picture unmirrored = test::render(scene.root, view);
    EXPECT_GT(both.different(unmirrored), 100) << "there is no mirror image to compare";
    halo->setScale(1.0);
    EXPECT_GT(test::render(scene.root, view).different(unmirrored), 100) << "there is no halo to compare";
}

TEST_P(SceneFile, KeepsTheBudgetOfAutomaticChoice) {
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    technique->setError(1.0 / 3.0);
    technique->setTime(0.7);
    const auto loaded = test::throughFile(*technique, kind());
    EXPECT_EQ(loaded->getError(), 1.0 / 3.0);
    EXPECT_EQ(loaded->getTime(), 0.7);
}

TEST_P(SceneFile, KeepsTheCascadesOfMaps) {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    technique->setCascades(3);
    const auto loaded = test::throughFile(*technique, kind());
    EXPECT_EQ(loaded->getCascades(), 3);
}

TEST_P(SceneFile, KeepsTheSoftEdgesAndTheViewOfMaps) {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    technique->setEdges(gnomon::ShadowMapTechnique::SOFT);
    technique->setSunAngle(0.1);
    technique->setLampSize(1.0 / 3.0);
    technique->setRadius(2.0 / 3.0);
    technique->setView(gnomon::ShadowMapTechnique::CASCADES);
    const auto loaded = test::throughFile(*technique, kind());
    EXPECT_EQ(loaded->getEdges(), gnomon::ShadowMapTechnique::SOFT);
    EXPECT_EQ(loaded->getSunAngle(), 0.1);
    EXPECT_EQ(loaded->getLampSize(), 1.0 / 3.0);
    EXPECT_EQ(loaded->getRadius(), 2.0 / 3.0);
    EXPECT_EQ(loaded->getView(), gnomon::ShadowMapTechnique::CASCADES);
}

TEST_P(SceneFile, KeepsTheViewOfVolumesAndTheirPicture) {
    const osg::ref_ptr<gnomon::ShadowVolumeTechnique> technique = new gnomon::ShadowVolumeTechnique;
    technique->setView(gnomon::ShadowVolumeTechnique::VOLUMES);
    EXPECT_EQ(test::throughFile(*technique, kind())->getView(), gnomon::ShadowVolumeTechnique::VOLUMES);
    test::Scene scene = boxOverGround(0.5);
    scene.addShadow(technique);
    expectSamePictureOnceLoaded(scene);
}

TEST_P(SceneFile, KeepsTheMethodOfATerrainShadowGeode) {
    osg::ref_ptr<gnomon::TerrainShadowGeode> shadow = new gnomon::TerrainShadowGeode;
    shadow->setMethod(gnomon::TerrainShadowGeode::BOX);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(shadow);
    root->addChild(new gnomon::TerrainShadowGeode);
    const auto copy = test::throughFile(*root, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(childOf<gnomon::TerrainShadowGeode>(*copy->asGroup(), 0).getMethod(), gnomon::TerrainShadowGeode::BOX);
    EXPECT_EQ(childOf<gnomon::TerrainShadowGeode>(*copy->asGroup(), 1).getMethod(), gnomon::TerrainShadowGeode::HULL);
}

/// As a file of an earlier version may have it.
TEST(TextFile, WithTheMethodDrapeLoadsAsHullAndSaysWhatTakesItsPlace) {
    test::usePluginsOfThisBuild();
    osg::ref_ptr<gnomon::TerrainShadowGeode> shadow = new gnomon::TerrainShadowGeode;
    shadow->setMethod(gnomon::TerrainShadowGeode::BOX);
    std::string file = test::written(*shadow, "osgt");
    file.replace(file.find("Method BOX"), 10, "Method DRAPE");
    testing::internal::CaptureStderr();
    const auto loaded = test::loaded(file, "osgt");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(dynamic_cast<const gnomon::TerrainShadowGeode&>(*loaded).getMethod(), gnomon::TerrainShadowGeode::HULL);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("Use hull on terrain, or map or traced"), std::string::npos) << said;
}

} // namespace
