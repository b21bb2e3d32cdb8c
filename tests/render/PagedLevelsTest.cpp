// SPDX-License-Identifier: MIT
// Nodes that choose what is drawn, beside LOD: tiles that an osgDB::DatabasePager loads, and bodies that move as a whole under
// levels of detail. Each picture equals that of what is drawn, without any choice.
#include "Hills.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <thread>

using namespace test;

namespace {

constexpr double finest = 260.0; // m: coarse beyond

osg::ref_ptr<osg::Node> fineTile(int column, int row) { return hillTile(column, row, 16); }
osg::ref_ptr<osg::Node> coarseTile(int column, int row) { return hillTile(column, row, 3); }

/// Reads "COLUMN_ROW.gnomontile", in the pager's thread.
class TileReader : public osgDB::ReaderWriter {
public:
    TileReader() { supportsExtension("gnomontile", "fine tiles of the test's hills"); }
    ReadResult readNode(const std::string& name, const Options*) const override {
        int column = 0, row = 0;
        if (std::sscanf(name.c_str(), "%d_%d.gnomontile", &column, &row) != 2) return ReadResult::FILE_NOT_HANDLED;
        return ReadResult(fineTile(column, row));
    }
};

osg::ref_ptr<osg::PagedLOD> pagedTile(int column, int row) {
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->setCenter(centreOfTile(column, row));
    lod->setRadius(100.0f);
    lod->addChild(coarseTile(column, row), float(finest), 1e9f);
    lod->setFileName(1, std::to_string(column) + "_" + std::to_string(row) + ".gnomontile");
    lod->setRange(1, 0.0f, float(finest));
    return lod;
}

using Technique = std::function<osg::ref_ptr<gnomon::ShadowTechnique>()>;
const Technique traced = [] { return new gnomon::TracedShadowTechnique; };
const Technique mapped = [] { return new gnomon::ShadowMapTechnique; };

Scene hills(const std::function<osg::ref_ptr<osg::Node>(int, int)>& tileAt, const Technique& technique) {
    Scene scene = test::scene(sunOverHills());
    for (int column = 0; column < 8; ++column)
        for (int row = 0; row < 8; ++row) scene.content->addChild(tileAt(column, row));
    if (technique) scene.addShadow(technique());
    return scene;
}

View from(const osg::Vec3d& hilltop) { return perspective(hilltop, {0.0, 0.0, 0.0}, 200, 150, 45.0, 1.0, 2000.0); }

/// As it is to look from there: tiles without levels.
Picture expectedFrom(const osg::Vec3d& hilltop, const Technique& technique) {
    const auto tileAt = [&](int column, int row) {
        const bool isNear = (osg::Vec3d(centreOfTile(column, row)) - hilltop).length() < finest;
        return isNear ? fineTile(column, row) : coarseTile(column, row);
    };
    return render(hills(tileAt, technique).root, from(hilltop));
}

/// A flight over paged tiles.
struct Flight {
    Flight(const Technique& technique, int frames)
        : rest(frames), scene(hills(pagedTile, technique)), camera(scene.root, from({})) {}

    /// The picture once all that is wanted is there, and nothing has changed for a while.
    Picture restAt(const osg::Vec3d& hilltop) {
        camera.setView(from(hilltop));
        osgDB::DatabasePager& pager = *camera.viewer().getDatabasePager();
        Picture picture = camera.frame();
        for (int still = 0; still < rest;) {
            still = pager.getRequestsInProgress() ? 0 : still + 1;
            if (still == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
            picture = camera.frame();
        }
        return picture;
    }
    int loaded() const {
        int count = 0;
        for (unsigned i = 0; i < scene.content->getNumChildren(); ++i) {
            const auto* lod = dynamic_cast<const osg::PagedLOD*>(scene.content->getChild(i));
            count += lod && lod->getNumChildren() == 2;
        }
        return count;
    }

    const int rest; ///< frames.
    Scene scene;
    Camera camera;
};

const osg::Vec3d here(-380.0, -380.0, 90.0), there(380.0, 300.0, 90.0);

/// A body of 256 triangles or more, and a small drawable.
std::vector<Mesh> shapes() {
    return {sphere({0.0, 0.0, 2.0}, 1.5, 24), sphere({0.0, 0.0, 2.0}, 1.5, 7), box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}),
            box({-2.0, -0.5, 0.0}, {0.0, 0.5, 3.0})};
}

const View onGround = perspective({0.0, -10.0, 6.0}, {0.0, 0.0, 1.0}, 160, 120, 40.0);

Scene groundWith(const osg::ref_ptr<osg::Node>& caster, const Technique& technique) {
    Scene scene = groundScene({}, 8.0, {1.0, -0.5, 1.5, 0.0});
    scene.content->addChild(caster);
    scene.addShadow(technique());
    return scene;
}

} // namespace

/// Tiles stay loaded for longer than the flight, near the place that it has left and out of sight.
TEST(PagedLevels, OfTilesCastAsTheyAreDrawnAlsoWhereTheyAreLeftBehind) {
    const osg::ref_ptr<TileReader> reader = new TileReader;
    osgDB::Registry::instance()->addReaderWriter(reader);
    struct Case {
        const char* name;
        Technique technique;
        int rest; ///< frames until maps are as if there had been no flight: at the third place 32.
    };
    for (const auto& [name, technique, rest] : {Case{"traced", traced, 2}, {"map", mapped, 36}}) {
        Flight flight(technique, rest);
        const Picture first = flight.restAt(here);
        const int loaded = flight.loaded();
        EXPECT_GT(loaded, 3);
        EXPECT_EQ(first.different(expectedFrom(here, technique)), 0) << name;
        EXPECT_EQ(flight.restAt(there).different(expectedFrom(there, technique)), 0) << name << ", elsewhere";
        EXPECT_GT(flight.loaded(), loaded + 3) << "and the first ones are still there";
        EXPECT_EQ(flight.restAt(here).different(first), 0) << name << ", back again";
        EXPECT_GT(first.different(expectedFrom(here, {})), 40) << "there are shadows";
    }
    osgDB::Registry::instance()->removeReaderWriter(reader);
}

/// It changes its level on the way.
TEST(PagedLevels, ABodyThatMovesCastsAsTheLevelThatIsDrawn) {
    for (const auto& [name, technique] : {std::pair("traced", traced), {"map", mapped}}) {
        const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
        lod->setCenter({0.0f, 0.0f, 2.0f});
        lod->addChild(node(shapes()[0]), 0.0f, 10.0f);
        lod->addChild(node(shapes()[1]), 10.0f, 1e9f);
        const osg::ref_ptr<osg::MatrixTransform> moving = new osg::MatrixTransform;
        moving->addChild(lod);
        Scene scene = groundWith(moving, technique);
        Camera camera(scene.root, onGround);
        for (const double y : {-2.0, -1.0, 0.5, 2.0, -1.5}) {
            const bool isNear = (osg::Vec3d(0.0, y, 2.0) - osg::Vec3d(0.0, -10.0, 6.0)).length() < 10.0;
            moving->setMatrix(osg::Matrixd::translate(0.0, y, 0.0));
            const osg::ref_ptr<osg::MatrixTransform> plain = new osg::MatrixTransform(moving->getMatrix());
            plain->addChild(node(shapes()[isNear ? 0 : 1]));
            const Picture expected = render(groundWith(plain, technique).root, onGround);
            EXPECT_LE(camera.frame().different(expected), name == std::string("map") ? 30 : 0) << name << y;
        }
    }
}
