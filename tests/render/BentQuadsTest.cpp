// SPDX-License-Identifier: MIT
// Quads that are not flat: which diagonal they are cut along is the driver's choice, and casters follow it. CTest runs this with
// each of Mesa's drivers, which cut alike; NVIDIA's cuts along the other one.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>

#include <array>
#include <numeric>

using test::Camera;
using test::Picture;
using test::Scene;
using test::View;

namespace {

constexpr int quads = 8; // along a side

/// How the sheet's quads are given to OpenGL.
struct Sheet {
    int first = 0;          ///< which of a quad's corners is its first.
    bool clockwise = false; ///< as seen from above.
    GLenum mode = GL_QUADS;
    bool listed = false;  ///< with indices.
    bool buffers = false; ///< in buffer objects, not in a display list.
    double bend = 0.05;   ///< heights are ± this, in turns.
};

osg::Vec3 post(const Sheet& sheet, int x, int y) {
    return {float(x - quads / 2), float(y - quads / 2), float((x + y) % 2 ? sheet.bend : -sheet.bend)};
}

/// A quad's corners in the order that is asked for.
std::array<osg::Vec3, 4> cornersOf(const Sheet& sheet, int x, int y) {
    const osg::Vec3 around[] = {post(sheet, x, y), post(sheet, x + 1, y), post(sheet, x + 1, y + 1),
                                post(sheet, x, y + 1)};
    std::array<osg::Vec3, 4> result;
    for (int i = 0; i < 4; ++i) result[std::size_t(i)] = around[(sheet.first + (sheet.clockwise ? 4 - i : i)) % 4];
    if (sheet.mode == GL_QUAD_STRIP) std::swap(result[2], result[3]);
    return result;
}

/// Each quad is a primitive of its own in a strip's mode. Normals are up, so that every bit of the surface is as bright.
osg::ref_ptr<osg::Node> nodeOf(const Sheet& sheet) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int i = 0; i < quads * quads; ++i)
        for (const osg::Vec3& corner : cornersOf(sheet, i % quads, i / quads)) vertices->push_back(corner);
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    const osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array;
    normal->push_back({0.0f, 0.0f, 1.0f});
    geometry->setNormalArray(normal, osg::Array::BIND_OVERALL);
    geometry->setUseDisplayList(!sheet.buffers);
    geometry->setUseVertexBufferObjects(sheet.buffers);
    const unsigned count = vertices->getNumElements(), each = sheet.mode == GL_QUADS ? count : 4;
    for (unsigned first = 0; first < count; first += each) {
        const osg::ref_ptr<osg::DrawElementsUShort> list = new osg::DrawElementsUShort(sheet.mode, each);
        std::iota(list->begin(), list->end(), static_cast<unsigned short>(first));
        if (sheet.listed)
            geometry->addPrimitiveSet(list);
        else
            geometry->addPrimitiveSet(new osg::DrawArrays(sheet.mode, int(first), int(each)));
    }
    if (sheet.buffers && sheet.listed) // OSG fills it list after list, of which Mesa complains where it is static
        geometry->getOrCreateElementBufferObject()->setUsage(GL_DYNAMIC_DRAW);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

/// 60° above the sheet, which rises by 11° at most: nothing of it is in shadow.
const osg::Vec4d sun(0.4, 0.3, 0.87, 0.0);
View fromTheSide() { return test::perspective({-4.0, -8.0, 9.0}, {0.0, 0.0, 0.0}, 96, 72, 55.0); }

template <class Technique>
Scene shadowed(const Sheet& sheet) {
    Scene scene = test::scene(sun);
    scene.content->addChild(nodeOf(sheet));
    scene.addShadow(new Technique);
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); // which shows on what faces away, too
    return scene;
}

/// Of the first frame, pixels of a sheet that a technique darkens though all of it is lit.
template <class Technique>
int wrongPixels(const Sheet& sheet) {
    Scene plain = test::scene(sun), scene = shadowed<Technique>(sheet);
    plain.content->addChild(nodeOf(sheet));
    const Picture lit = test::render(plain.root, fromTheSide());
    return test::render(scene.root, fromTheSide()).different(lit);
}

std::vector<Sheet> allSheets() {
    std::vector<Sheet> sheets;
    for (int first = 0; first < 4; ++first)
        for (const bool clockwise : {false, true}) sheets.push_back({first, clockwise});
    sheets.push_back({0, false, GL_QUAD_STRIP});
    sheets.push_back({1, true, GL_QUAD_STRIP});
    sheets.push_back({1, false, GL_QUADS, true});
    sheets.push_back({2, true, GL_QUADS, true, true});
    sheets.push_back({3, true, GL_QUAD_STRIP, true, true});
    sheets.push_back({0, false, GL_QUADS, false, false, 0.01});
    return sheets;
}

std::ostream& operator<<(std::ostream& out, const Sheet& sheet) {
    return out << (sheet.mode == GL_QUADS ? "quads" : "strips") << " from corner " << sheet.first
               << (sheet.clockwise ? ", clockwise" : "") << (sheet.listed ? ", listed" : "")
               << (sheet.buffers ? ", in buffers" : "") << ", bent by " << sheet.bend;
}

TEST(BentQuads, DoNotShadowThemselves) {
    for (const Sheet& sheet : allSheets()) {
        EXPECT_EQ(wrongPixels<gnomon::TracedShadowTechnique>(sheet), 0) << "traced: " << sheet;
        EXPECT_EQ(wrongPixels<gnomon::ShadowMapTechnique>(sheet), 0) << "map: " << sheet;
    }
}

/// Where the depth buffer has the surface.
std::vector<osg::Vec3d> seenPlaces(gnomon::HeadlessContext& context, const View& view) {
    const osg::ref_ptr<osg::Image> depth = context.depth();
    const osg::Matrixd worldFromClip = osg::Matrixd::inverse(view.view * view.projection);
    std::vector<osg::Vec3d> places;
    for (int y = 0; y < view.height; y += 3)
        for (int x = 0; x < view.width; x += 3) {
            const double z = *reinterpret_cast<const float*>(depth->data(x, y));
            if (z < 1.0)
                places.push_back(
                    osg::Vec3d((x + 0.5) / view.width * 2.0 - 1.0, (y + 0.5) / view.height * 2.0 - 1.0, z * 2.0 - 1.0) *
                    worldFromClip);
        }
    return places;
}

TEST(BentQuads, AreLitWhereAQueryAsksAboutWhatIsDrawn) {
    for (const int first : {0, 1}) {
        Scene scene = shadowed<gnomon::TracedShadowTechnique>({first});
        Camera camera(scene.root, fromTheSide());
        camera.frame();
        const auto* technique = dynamic_cast<gnomon::TracedShadowTechnique*>(scene.group->getChild(1));
        const gnomon::ShadowQuery query(*technique, {0, sun});
        int wrong = 0;
        const std::vector<osg::Vec3d> places = seenPlaces(camera.context(), fromTheSide());
        for (const osg::Vec3d& place : places) wrong += !query.isLit(place + osg::Vec3d(0.0, 0.0, 1e-3));
        EXPECT_GT(places.size(), 100u);
        EXPECT_EQ(wrong, 0) << "from corner " << first; // 1 mm above, for depths are right to a tenth of that
    }
}

} // namespace
