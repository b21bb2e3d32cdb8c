// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/VertexTraverser.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/casters/Casters.h>

#include <osg/AlphaFunc>
#include <osg/CullFace>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Switch>
#include <osg/Texture2D>
#include <osg/observer_ptr>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>

using gnomon::Casters;

namespace {

/// A triangle at (x, 0, 0) … (x + 1, 1, 0).
osg::ref_ptr<osg::Geometry> triangle(float x) {
    return scene::geometryOf(scene::vec3s({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}),
                             new osg::DrawArrays(GL_TRIANGLES, 0, 3));
}

struct Row {
    Row() {
        for (int i = 0; i < 6; ++i)
            root->addChild(scene::under(osg::Matrixd::translate(10.0 * i, 0, 0), triangle(0.0f)));
    }
    osg::MatrixTransform& place(unsigned i) { return static_cast<osg::MatrixTransform&>(*root->getChild(i)); }
    osg::ref_ptr<const Casters> now(const osg::ref_ptr<const Casters>& known) { return Casters::of(*root, {}, known); }
    osg::ref_ptr<osg::Group> root = new osg::Group;
};

int shared(const Casters& a, const Casters& b) {
    int count = 0;
    for (const auto& piece : a.list) count += std::count(b.list.begin(), b.list.end(), piece) > 0;
    return count;
}

/// Counts the nodes it meets.
class Counting : public gnomon::CasterFingerprint {
public:
    using CasterFingerprint::apply;
    using CasterFingerprint::CasterFingerprint;
    void apply(osg::Node& node) override {
        ++met;
        CasterFingerprint::apply(node);
    }
    int met = 0;
};

} // namespace

TEST(Casters, AreTheSameAsLongAsNothingChanges) {
    Row row;
    const auto first = row.now(nullptr);
    ASSERT_EQ(first->list.size(), 6u);
    EXPECT_EQ(first->bounds._min, osg::Vec3d(0.0, 0.0, 0.0));
    EXPECT_EQ(first->bounds._max, osg::Vec3d(51.0, 1.0, 0.0));
    EXPECT_EQ(row.now(first), first);
}

/// A list is an id, here of no context. What is edited is inside the bounds.
TEST(Casters, AreReadAgainOnceADisplayListIsReleased) {
    const osg::ref_ptr<osg::Geometry> geometry = triangle(0.0f);
    auto& vertices = static_cast<osg::Vec3Array&>(*geometry->getVertexArray());
    vertices.push_back({0.5f, 0.5f, 0.0f});
    const auto now = [&](const osg::ref_ptr<const Casters>& known) { return Casters::of(*geometry, {}, known); };
    auto known = now(nullptr);
    for (int edit = 0; edit < 3; ++edit) {
        vertices[3].x() *= 0.5f; // before the second visit, too
        const auto edited = now(known);
        EXPECT_NE(edited, known) << edit;
        EXPECT_EQ(now(edited), edited) << edit;
        geometry->getDisplayList(0) = 1;
        EXPECT_EQ(now(edited), edited) << edit;
        geometry->getDisplayList(0) = 0;
        EXPECT_EQ(now(edited), edited) << "released, but as before";
        known = edited;
    }
}

/// It hands out no triangles, and has a list that no view makes.
struct Silent : public osg::Drawable {
    Silent() { setUseDisplayList(true); }
    Silent(const Silent& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp) {}
    META_Object(test, Silent)
    osg::BoundingBox computeBoundingBox() const override { return {0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f}; }
    void drawImplementation(osg::RenderInfo&) const override {}
};

TEST(Casters, OfWhatNoViewDrawsComeToRest) {
    const osg::ref_ptr<Silent> drawable = new Silent;
    const auto now = [&](const osg::ref_ptr<const Casters>& known) { return Casters::of(*drawable, {}, known); };
    auto known = now(nullptr);
    ASSERT_EQ(known->selfDrawings.size(), 1u);
    for (int visit = 0; visit < 8; ++visit)
        known = now(known); // the first may be those of views that have not drawn it yet
    EXPECT_EQ(now(known), known);
}

TEST(Casters, OfAChangeAreNewOnlyWhereItIs) {
    Row row;
    auto known = row.now(nullptr);
    const auto expect = [&](std::size_t size, int same, const char* what) {
        const auto now = row.now(known);
        EXPECT_NE(now, known) << what;
        EXPECT_EQ(now->list.size(), size) << what;
        EXPECT_EQ(shared(*now, *known), same) << what;
        EXPECT_EQ(row.now(now), now) << what;
        known = now;
    };
    row.place(2).setMatrix(osg::Matrixd::translate(20.5, 0.0, 0.0));
    expect(6, 5, "one moved");
    EXPECT_EQ(known->list[2]->bounds.xMin(), 20.5);
    auto& corners = static_cast<osg::Vec3Array&>(*row.place(5).getChild(0)->asGeometry()->getVertexArray());
    corners[0].x() = -1.0f;
    corners.dirty();
    expect(6, 5, "the last one's corners changed");
    EXPECT_EQ(known->list[5]->bounds.xMin(), 49.0);
    row.root->addChild(triangle(99.0f));
    expect(7, 6, "one more");
    row.root->insertChild(0, triangle(199.0f));
    row.root->insertChild(4, triangle(299.0f));
    expect(9, 7, "two in between");
    row.root->removeChild(6);
    expect(8, 8, "one less");
    row.root->removeChildren(1, 4);
    EXPECT_GE(shared(*row.now(known), *known), 3) << "four less: but for one everything is known again";
}

TEST(Casters, NameWhatIsNotUsable) {
    Row row;
    auto& corners = static_cast<osg::Vec3Array&>(*row.place(1).getChild(0)->asGeometry()->getVertexArray());
    corners[1].y() = std::numeric_limits<float>::quiet_NaN();
    row.place(1).setName("broken");
    const auto pieces = row.now(nullptr);
    EXPECT_EQ(pieces->invalidTriangles, 1u);
    EXPECT_EQ(pieces->invalidNode, "broken");
    row.root->removeChildren(0, 1);
    row.root->removeChildren(1, 4);
    EXPECT_TRUE(row.now(nullptr)->empty());
}

// One pane below two parents, of which the second alone has a test: a mesh of pieces knows them apart without the nodes above.
TEST(Casters, AreTestedAsTheWayDownToThemSays) {
    const osg::ref_ptr<osg::Geometry> pane = triangle(0.0f);
    pane->setTexCoordArray(0, scene::vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    osg::ref_ptr<osg::Group> root = new osg::Group;
    for (int i = 0; i < 2; ++i) root->addChild(scene::under(osg::Matrixd::translate(5.0 * i, 0, 0), pane));
    osg::StateSet& set = *root->getChild(1)->getOrCreateStateSet();
    const osg::ref_ptr<osg::Image> image = new osg::Image; // without one it would be rendered to
    image->allocateImage(1, 1, 1, GL_RGBA, GL_FLOAT);
    image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 0.5f), 0u, 0u);
    set.setTextureAttributeAndModes(0, new osg::Texture2D(image));
    set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    const auto pieces = Casters::of(*root, {}, nullptr);
    const osg::ref_ptr<gnomon::CasterMesh> mesh = gnomon::meshOf(pieces->list);
    ASSERT_EQ(mesh->cutouts.size(), 1u);
    EXPECT_EQ(mesh->cutouts[0].drawn, 1u);
    EXPECT_EQ(pieces->cutouts, 1u);
    EXPECT_TRUE(pieces->selfDrawings.empty());
    pane->setTexCoordArray(0, nullptr);
    const auto unknown = Casters::of(*root, {}, pieces);
    EXPECT_EQ(unknown->cutouts, 1u) << "by the state of what is above it";
    ASSERT_EQ(unknown->selfDrawings.size(), 1u);
    EXPECT_EQ(unknown->selfDrawings.front()->groupFromLocal.getTrans().x(), 5.0);
}

namespace {

/// 8 × 4 texels whose alpha is 1 in the first three columns, and 0 else.
osg::ref_ptr<osg::Texture2D> leftTexture(osg::Texture::WrapMode wrap = osg::Texture::REPEAT) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 4, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 8; ++column)
            image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, column < 3 ? 1.0f : 0.0f), column, row);
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto which : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(which, wrap);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(which, osg::Texture::NEAREST);
    return texture;
}

/// A triangle that shows columns of a texture, by blending.
struct Leaf {
    Leaf(osg::Texture2D* texture, float firstColumn, float endColumn) {
        const float s = firstColumn / 8.0f, t = endColumn / 8.0f;
        drawable->setTexCoordArray(0, scene::vec3s({{s, 0, 0}, {t, 0, 0}, {s, 1, 0}}));
        osg::StateSet& set = *drawable->getOrCreateStateSet();
        set.setTextureAttributeAndModes(0, texture);
        set.setMode(GL_BLEND, osg::StateAttribute::ON);
        place->addChild(drawable);
    }
    osg::ref_ptr<const Casters> pieces(const osg::ref_ptr<const Casters>& known = nullptr) const {
        return Casters::of(*place, {}, known, nullptr, nullptr, {0.5f});
    }
    osg::ref_ptr<osg::Geometry> drawable = triangle(0.0f);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
};

} // namespace

TEST(Casters, AreClearSolidOrCutOutByTheTexelsThatTheyShow) {
    struct Case {
        osg::Texture::WrapMode wrap;
        float first, end; ///< columns.
        std::size_t triangles;
        unsigned cutouts;
    };
    for (const Case& each : {Case{osg::Texture::REPEAT, 0, 3, 1, 0},
                             {osg::Texture::REPEAT, 3, 8, 0, 0},
                             {osg::Texture::REPEAT, 0, 8, 1, 1},
                             {osg::Texture::REPEAT, 2, 4, 1, 1},
                             {osg::Texture::REPEAT, 16, 19, 1, 0},
                             {osg::Texture::REPEAT, 11, 16, 0, 0},
                             {osg::Texture::REPEAT, 15, 17, 1, 1},
                             {osg::Texture::REPEAT, -5, -1, 0, 0},
                             {osg::Texture::MIRROR, 8, 13, 0, 0},
                             {osg::Texture::MIRROR, 13, 16, 1, 0},
                             {osg::Texture::MIRROR, -3, 0, 1, 0},
                             {osg::Texture::MIRROR, -8, -4, 0, 0},
                             {osg::Texture::CLAMP_TO_EDGE, -9, 2, 1, 0},
                             {osg::Texture::CLAMP_TO_EDGE, 9, 20, 0, 0},
                             {osg::Texture::CLAMP_TO_BORDER, -9, 2, 1, 1}}) {
        const auto pieces = Leaf(leftTexture(each.wrap), each.first, each.end).pieces();
        EXPECT_EQ(pieces->list.front()->triangles, each.triangles) << each.wrap << " " << each.first;
        EXPECT_EQ(pieces->cutouts, each.cutouts) << each.wrap << " " << each.first;
    }
}

/// Those left out are t = 0 and q = 1, and a fourth divides the others: each array shows the same columns of the texture.
TEST(Casters, AreToldByTextureCoordinatesOfOneToFourNumbers) {
    struct Case {
        float first, end; ///< columns.
        std::size_t triangles;
        unsigned cutouts;
    };
    for (const Case& each : {Case{0, 3, 1, 0}, {3, 8, 0, 0}, {2, 4, 1, 1}}) {
        const float s = each.first / 8.0f, t = each.end / 8.0f;
        const std::array<float, 3> columns{s, t, s}, rows{0.0f, 0.0f, 1.0f};
        const osg::ref_ptr<osg::FloatArray> ones = new osg::FloatArray;
        const osg::ref_ptr<osg::Vec2Array> twos = new osg::Vec2Array;
        const osg::ref_ptr<osg::Vec4Array> fours = new osg::Vec4Array;
        const osg::ref_ptr<osg::Vec4dArray> doubles = new osg::Vec4dArray;
        for (std::size_t i = 0; i < 3; ++i) {
            const float q = i == 1 ? 4.0f : 2.0f;
            ones->push_back(columns[i]);
            twos->push_back({columns[i], rows[i]});
            fours->push_back(osg::Vec4(columns[i], rows[i], 0.0f, 1.0f) * q);
            doubles->push_back(osg::Vec4d(fours->back()));
        }
        for (const osg::ref_ptr<osg::Array>& array :
             std::initializer_list<osg::ref_ptr<osg::Array>>{ones.get(), twos.get(), fours.get(), doubles.get()}) {
            Leaf leaf(leftTexture(), each.first, each.end);
            leaf.drawable->setTexCoordArray(0, array, osg::Array::BIND_PER_VERTEX);
            const auto pieces = leaf.pieces();
            EXPECT_EQ(pieces->list.front()->triangles, each.triangles) << each.first << " " << array->getDataSize();
            EXPECT_EQ(pieces->cutouts, each.cutouts) << each.first << " " << array->getDataSize();
            EXPECT_TRUE(pieces->selfDrawings.empty()) << each.first << " " << array->getDataSize();
        }
    }
}

// A linear filter mixes the neighbour in.
TEST(Casters, AreCutOutByTexelsThatAFilterReaches) {
    const osg::ref_ptr<osg::Texture2D> texture = leftTexture();
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    EXPECT_EQ(Leaf(texture, 0.5f, 2.5f).pieces()->cutouts, 0u);
    EXPECT_EQ(Leaf(texture, 0.5f, 3.0f).pieces()->cutouts, 1u);
    EXPECT_EQ(Leaf(texture, 3.5f, 7.5f).pieces()->list.front()->triangles, 0u);
}

// osgViewer lets images go once they are drawn.
TEST(Casters, KnowAnImageThatIsGone) {
    const osg::ref_ptr<osg::Texture2D> texture = leftTexture();
    texture->setUnRefImageDataAfterApply(true);
    const Leaf leaf(texture, 0, 3);
    const auto before = leaf.pieces();
    EXPECT_EQ(before->cutouts, 0u);
    const osg::observer_ptr<osg::Image> image = texture->getImage();
    texture->setTextureSize(8, 4); // as the image's: drawing sets it
    texture->setImage(nullptr);
    EXPECT_FALSE(image.valid()) << "it takes memory";
    EXPECT_EQ(leaf.pieces(before), before);
    Leaf other(texture, 3, 8);
    leaf.place->addChild(other.drawable);
    const auto after = leaf.pieces(before);
    ASSERT_EQ(after->list.size(), 2u);
    EXPECT_EQ(after->list.back()->triangles, 0u);
}

// Two that are alike in one place, behind one that moves.
TEST(Casters, OfEqualOnesStayTheSame) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->addChild(triangle(0.0f));
    const osg::ref_ptr<osg::Geometry> twice = triangle(3.0f);
    root->addChild(mover);
    root->addChild(twice);
    root->addChild(twice);
    const auto before = Casters::of(*root, {}, nullptr);
    mover->setMatrix(osg::Matrixd::translate(0.0, 0.0, 1.0));
    const auto after = Casters::of(*root, {}, before);
    ASSERT_EQ(after->list.size(), 3u);
    EXPECT_NE(after->list[0], before->list[0]);
    EXPECT_EQ(after->list[1], before->list[1]);
    EXPECT_EQ(after->list[2], before->list[2]);
}

/// Exactly: 10 + 1 is where the next begins.
TEST(Casters, AreWeldedWhereTheyShareACorner) {
    Row row;
    row.place(1).setMatrix(osg::Matrixd::translate(1.0, 0.0, 0.0));
    row.place(3).setMatrix(osg::Matrixd::translate(41.0, 0.0, 0.0));
    row.place(5).setMatrix(osg::Matrixd::translate(40.25, 0.0, 0.0)); // meets others' bounds, none of their corners
    const auto pieces = row.now(nullptr);
    EXPECT_EQ(gnomon::weldedCasters(pieces->list), (std::vector<std::size_t>{0, 0, 2, 3, 3, 5}));
}

TEST(Casters, KnowWhatOneSeesThrough) {
    using gnomon::Hiding;
    using A = osg::StateAttribute;
    Row row;
    gnomon::CasterView view;
    auto known = row.now(nullptr);
    const auto hidingOf = [&](unsigned i) {
        known = Casters::of(*row.root, {}, known, &view);
        return known->list[i]->hiding;
    };
    const auto set = [&](unsigned i) -> osg::StateSet& { return *row.place(i).getOrCreateStateSet(); };
    for (unsigned i = 0; i < 6; ++i) EXPECT_EQ(hidingOf(i), Hiding::Both) << i;

    set(0).setAttributeAndModes(new osg::CullFace);
    set(1).setMode(GL_BLEND, A::ON);
    EXPECT_EQ(hidingOf(0), Hiding::Fronts);
    EXPECT_EQ(hidingOf(1), Hiding::Both) << "its depth stands before shadows are drawn";
    set(1).setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    EXPECT_EQ(hidingOf(1), Hiding::Neither);
    set(2).setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    EXPECT_EQ(hidingOf(2), Hiding::Neither);
    set(3).setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::BACK, osg::PolygonMode::LINE));
    EXPECT_EQ(hidingOf(3), Hiding::Neither);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() { if (gl_FragCoord.x > 9.0) discard; }"));
    set(4).setAttributeAndModes(program);
    EXPECT_EQ(hidingOf(4), Hiding::Neither);
    view.mask = 1;
    row.place(5).setNodeMask(2);
    EXPECT_EQ(hidingOf(5), Hiding::Neither);
    EXPECT_EQ(hidingOf(0), Hiding::Fronts);

    row.root->getOrCreateStateSet()->setMode(GL_ALPHA_TEST, A::OFF | A::OVERRIDE);
    EXPECT_EQ(hidingOf(2), Hiding::Both) << "as OpenSceneGraph inherits";
    row.place(0).setMatrix(osg::Matrixd::scale(-1.0, 1.0, 1.0));
    EXPECT_EQ(hidingOf(0), Hiding::Neither) << "OpenGL takes the mirrored one's fronts for backs";
}

/// Of many things beside the selected one none is visited.
TEST(CasterVisitor, GoesStraightToTheSelectedNode) {
    osg::ref_ptr<osg::Group> root = new osg::Group, aside = new osg::Group, town = new osg::Group;
    osg::ref_ptr<osg::Switch> chosen = new osg::Switch;
    for (int i = 0; i < 100; ++i) town->addChild(new osg::Group);
    root->addChild(town);
    root->addChild(chosen);
    root->addChild(aside);
    osg::ref_ptr<osg::Geode> terrain = new osg::Geode;
    terrain->addDrawable(triangle(0.0f));
    chosen->addChild(terrain);
    aside->addChild(terrain);
    Counting all, found({terrain});
    root->accept(all);
    root->accept(found);
    EXPECT_GT(all.met, 100);
    EXPECT_EQ(found.met, 5) << "the root, two ways, and twice the terrain";
    const std::uint64_t both = found.value();
    chosen->setAllChildrenOff();
    found.reset();
    root->accept(found);
    EXPECT_NE(found.value(), both) << "a switch counts on the way";
    EXPECT_NE(found.value(), gnomon::CasterFingerprint().value());
}
