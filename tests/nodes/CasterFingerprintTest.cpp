// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/CasterVisitor.h>

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/ClipNode>
#include <osg/CullFace>
#include <osg/LOD>
#include <osg/PrimitiveRestartIndex>
#include <osg/PrimitiveSetIndirect>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osg/TexMat>
#include <osg/Texture2D>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>

using namespace scene;

namespace {

std::atomic<std::size_t> news{0};

/// How often `operator new` has been called in this program, by any library and thread.
std::size_t countedNews() { return news; }

} // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++news;
    return std::malloc(size > 0 ? size : 1);
}

void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}

void* operator new[](std::size_t size) { return operator new(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return operator new(size, std::nothrow); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using Mode = osg::PrimitiveSet::Mode;

namespace {

/// A graph watched as a group watches its casters: by a value, and the mesh of that value.
class Watched {
public:
    explicit Watched(osg::Node* root) : _root(root) {
        _revision.setRule({0.5f});
        changed();
    }

    /// Whether the value differs from that of the call before.
    bool changed() {
        _revision.reset();
        _root->accept(_revision);
        gnomon::CasterFingerprint another;
        another.setRule({0.5f});
        _root->accept(another);
        EXPECT_EQ(another.value(), _revision.value()) << "two visitors agree";
        const bool differs = _revision.value() != _value;
        _value = _revision.value();
        if (differs) extract();
        return differs;
    }

private:
    void extract() {
        gnomon::CasterExtraction casters;
        casters.setRule({0.5f});
        _root->accept(casters);
        _mesh = new gnomon::CasterMesh(casters);
    }

    osg::ref_ptr<osg::Node> _root;
    gnomon::CasterFingerprint _revision;
    std::uint64_t _value = 0;
    osg::ref_ptr<gnomon::CasterMesh> _mesh;
};

/// It changes with each of these, and stands still in between.
void expectChangeWithEach(Watched& watched, const std::vector<std::function<void()>>& acts) {
    for (std::size_t i = 0; i < acts.size(); ++i) {
        acts[i]();
        EXPECT_TRUE(watched.changed()) << "act " << i;
        EXPECT_FALSE(watched.changed()) << "act " << i;
    }
}

osg::Vec3Array& verticesOf(osg::Geometry& geometry) { return *static_cast<osg::Vec3Array*>(geometry.getVertexArray()); }

osg::ref_ptr<osg::Geometry> indexed() {
    return geometryOf(vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}),
                      new osg::DrawElementsUInt(Mode::TRIANGLES, 3, std::array<GLuint, 3>{0, 1, 2}.data()));
}

/// Boxes under transforms, as a town has them.
osg::ref_ptr<osg::Group> boxes(int count) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box);
    for (int i = 0; i < count; ++i) root->addChild(under(osg::Matrix::translate(2.0 * i, 0, 0), geodeOf(box.get())));
    return root;
}

} // namespace

TEST(CasterRevisionChanges, WithEachDrawableAddedRemovedOrReordered) {
    const osg::ref_ptr<osg::Geode> geode = geodeOf(triangle().get());
    Watched watched(geode.get());
    const osg::ref_ptr<osg::Drawable> first = geode->getDrawable(0);
    expectChangeWithEach(watched, {[&] { geode->addDrawable(indexed()); },
                                   [&] {
                                       geode->setDrawable(0, geode->getDrawable(1));
                                       geode->setDrawable(1, first);
                                   },
                                   [&] { geode->removeDrawable(first); }});
}

TEST(CasterRevisionChanges, WithATransformsMatrixAndWhenTwoObjectsChangePlaces) {
    const osg::ref_ptr<osg::Group> root = boxes(2);
    Watched watched(root.get());
    auto& a = static_cast<osg::MatrixTransform&>(*root->getChild(0));
    auto& b = static_cast<osg::MatrixTransform&>(*root->getChild(1));
    expectChangeWithEach(watched, {[&] { a.setMatrix(osg::Matrix::translate(std::nextafter(1.0, 2.0), 0, 0)); },
                                   [&] {
                                       const osg::Matrixd before = a.getMatrix();
                                       a.setMatrix(b.getMatrix());
                                       b.setMatrix(before);
                                   }});
}

TEST(CasterRevisionChanges, WithASwitchAMaskAndTheRangesOfAnLod) {
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    choice->addChild(triangleAt(1));
    choice->addChild(lod);
    lod->addChild(triangleAt(2), 0, 10);
    lod->addChild(triangleAt(3), 10, 100);
    Watched watched(choice.get());
    expectChangeWithEach(watched, {[&] { choice->setValue(0, false); }, [&] { lod->setRange(0, 100, 1000); },
                                   [&] { lod->addChild(triangleAt(4), 0, 10); }, [&] { lod->setNodeMask(0); }});
}

TEST(CasterRevisionChanges, WithAVertexArrayDirtiedResizedOrReplaced) {
    const osg::ref_ptr<osg::Geometry> geometry = triangle();
    Watched watched(geometry.get());
    expectChangeWithEach(watched, {[&] {
                                       verticesOf(*geometry)[0].x() = 0.5f;
                                       verticesOf(*geometry).dirty();
                                   },
                                   [&] {
                                       verticesOf(*geometry).push_back({1, 1, 1});
                                   },
                                   [&] {
                                       geometry->setVertexArray(vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}));
                                   },
                                   [&] { geometry->setVertexArray(nullptr); }});
}

TEST(CasterRevisionChanges, WithPrimitivesDirtiedResizedMovedReplacedOrOfAnotherMode) {
    const osg::ref_ptr<osg::Geometry> geometry = indexed();
    Watched watched(geometry.get());
    auto& elements = static_cast<osg::DrawElementsUInt&>(*geometry->getPrimitiveSet(0));
    osg::ref_ptr<osg::DrawArrays> arrays = new osg::DrawArrays(Mode::TRIANGLES, 0, 3);
    expectChangeWithEach(watched, {[&] {
                                       elements[2] = 3;
                                       elements.dirty();
                                   },
                                   [&] {
                                       elements.asVector().insert(elements.asVector().end(), {1u, 2u, 0u});
                                   },
                                   [&] { elements.setMode(Mode::TRIANGLE_STRIP); },
                                   [&] { geometry->setPrimitiveSet(0, arrays); }, [&] { arrays->setFirst(1); },
                                   [&] { geometry->removePrimitiveSet(0); }});
}

TEST(CasterRevisionChanges, WithVerticesAndIndicesEditedWhereThereIsNeitherListNorBuffer) {
    const osg::ref_ptr<osg::Geometry> geometry =
        geometryOf(vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}}),
                   new osg::DrawElementsUInt(Mode::TRIANGLES, 6, std::array<GLuint, 6>{0, 1, 4, 2, 3, 4}.data()));
    auto& elements = static_cast<osg::DrawElementsUInt&>(*geometry->getPrimitiveSet(0));
    geometry->setUseDisplayList(false);
    Watched watched(geometry.get());
    expectChangeWithEach(watched, {[&] { verticesOf(*geometry)[4].x() = 0.25f; }, [&] { elements[5] = 0; }});
    geometry->setUseDisplayList(true);
    geometry->setDataVariance(osg::Object::DYNAMIC);
    EXPECT_FALSE(watched.changed());
    expectChangeWithEach(watched, {[&] { verticesOf(*geometry)[4].x() = 0.5f; }});
    geometry->setUseVertexBufferObjects(true); // whose copy only a count renews: the picture stays, too
    watched.changed();
    verticesOf(*geometry)[4].x() = 0.75f;
    EXPECT_FALSE(watched.changed());
    expectChangeWithEach(watched, {[&] { verticesOf(*geometry).dirty(); }});
}

TEST(CasterRevisionChanges, WithTheBoundsOfAGeometry) {
    const osg::ref_ptr<osg::Geometry> geometry = indexed();
    Watched watched(geometry.get());
    expectChangeWithEach(watched, {[&] {
                             verticesOf(*geometry)[2].z() = 2.0f;
                             geometry->dirtyBound();
                         }});
}

TEST(CasterRevisionChanges, WithTheShapeOfAShapeDrawable) {
    // Its arrays are deleted before the new ones, of the same sizes, are made: an allocator may well give the same
    // places.
    const osg::ref_ptr<osg::ShapeDrawable> shape = new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 1.0f));
    Watched watched(shape.get());
    for (int i = 0; i < 100; ++i) {
        shape->setShape(new osg::Box(osg::Vec3(), 2.0f + static_cast<float>(i)));
        EXPECT_TRUE(watched.changed());
    }
}

TEST(CasterRevisionChanges, WithTheBoundsOfADrawableThatIsNoGeometryIfItHasTriangles) {
    class Unknown : public osg::Drawable {
    public:
        bool supports(const osg::PrimitiveFunctor&) const override { return hasTriangles; }
        bool hasTriangles = true;
    };
    for (const bool hasTriangles : {true, false}) {
        const osg::ref_ptr<Unknown> unknown = new Unknown;
        unknown->hasTriangles = hasTriangles;
        Watched watched(unknown.get());
        EXPECT_FALSE(watched.changed());
        unknown->setInitialBound(osg::BoundingBox(0, 0, 0, 1, 1, 1));
        EXPECT_EQ(watched.changed(), hasTriangles);
    }
}

TEST(CasterRevisionChanges, WithWhatAnAlphaTestGoesBy) {
    const osg::ref_ptr<osg::Geometry> geometry = indexed();
    const osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array(4);
    geometry->setTexCoordArray(0, coordinates);
    const osg::ref_ptr<osg::Group> above = new osg::Group, root = new osg::Group;
    above->addChild(root);
    root->addChild(geometry);
    Watched watched(root.get());
    osg::StateSet& set = *geometry->getOrCreateStateSet();
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    set.setTextureAttributeAndModes(0, new osg::Texture2D(image));
    const osg::ref_ptr<osg::AlphaFunc> test = new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f);
    set.setAttribute(test);
    EXPECT_FALSE(watched.changed()) << "no test is on";
    expectChangeWithEach(watched,
                         {[&] { above->getOrCreateStateSet()->setMode(GL_ALPHA_TEST, osg::StateAttribute::ON); },
                          [&] { test->setReferenceValue(0.4f); }, [&] { test->setFunction(osg::AlphaFunc::LESS); },
                          [&] { image->dirty(); }, [&] { coordinates->dirty(); },
                          [&] { set.setTextureAttribute(0, new osg::TexMat(osg::Matrixd::scale(2.0, 1.0, 1.0))); },
                          [&] { set.setTextureAttribute(0, new osg::Texture2D(image)); },
                          [&] { test->setFunction(osg::AlphaFunc::ALWAYS); }});
}

TEST(CasterRevisionChanges, WithWhatElseAStateLeavesOfIt) {
    const osg::ref_ptr<osg::Geometry> geometry = indexed();
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(4);
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(geometry);
    clip->addChild(place);
    Watched watched(clip.get());
    const osg::ref_ptr<osg::ClipPlane> plane = new osg::ClipPlane(2, osg::Vec4d(1.0, 0.0, 0.0, -0.5));
    osg::StateSet& set = *geometry->getOrCreateStateSet();
    const osg::ref_ptr<osg::PrimitiveRestartIndex> restart = new osg::PrimitiveRestartIndex(1);
    const osg::ref_ptr<osg::DrawElementsIndirectUInt> indirect =
        new osg::DrawElementsIndirectUInt(Mode::TRIANGLES, 3, std::array<GLuint, 3>{0, 1, 2}.data());
    expectChangeWithEach(watched,
                         {[&] { clip->addClipPlane(plane); }, [&] { plane->setClipPlane(1.0, 0.0, 0.0, -0.25); },
                          [&] { clip->getStateSet()->setMode(GL_CLIP_PLANE0 + 2, osg::StateAttribute::OFF); },
                          [&] { set.setMode(GL_BLEND, osg::StateAttribute::ON); }, [&] { colors->dirty(); },
                          [&] { set.setMode(GL_BLEND, osg::StateAttribute::OFF); },
                          [&] {
                              set.setAttributeAndModes(restart);
                              set.setMode(GL_PRIMITIVE_RESTART, osg::StateAttribute::ON);
                          },
                          [&] { restart->setRestartIndex(2); }, [&] { geometry->setPrimitiveSet(0, indirect); },
                          [&] { indirect->getIndirectCommandArray()->resizeElements(1); },
                          [&] { indirect->getIndirectCommandArray()->dirty(); },
                          [&] { set.setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT_AND_BACK)); }});
}

TEST(CasterRevisionStays, WhenAClipPlaneMovesThatCutsNothing) {
    const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
    const osg::ref_ptr<osg::ClipPlane> plane = new osg::ClipPlane(0, osg::Vec4d(0.0, 0.0, 1.0, 5.0));
    clip->addClipPlane(plane);
    clip->addChild(indexed());
    Watched watched(clip.get());
    plane->setClipPlane(0.0, 0.0, 1.0, 4.0);
    EXPECT_FALSE(watched.changed());
}

TEST(CasterRevisionStays, WhenWhatDoesNotCastChanges) {
    const osg::ref_ptr<osg::Geometry> geometry = triangle();
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(geodeOf(geometry.get()));
    Watched watched(root.get());
    root->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    geometry->setColorArray(new osg::Vec4Array(1), osg::Array::BIND_OVERALL);
    geometry->setNormalArray(new osg::Vec3Array(1), osg::Array::BIND_OVERALL);
    geometry->dirtyDisplayList();
    geometry->dirtyBound();
    root->setName("another");
    root->addChild(new osg::Group);
    EXPECT_FALSE(watched.changed());
}

TEST(CasterRevisionStays, WhenAChildThatIsOffOrNotSelectedChanges) {
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    const osg::ref_ptr<osg::MatrixTransform> off = triangleAt(1);
    choice->addChild(off, false);
    choice->addChild(triangleAt(2), true);
    Watched watched(choice.get());
    off->setMatrix(osg::Matrix::translate(9, 9, 9));
    EXPECT_FALSE(watched.changed());
}

TEST(CasterFingerprint, AllocatesNothingOnceWarm) {
    const osg::ref_ptr<osg::Group> root = boxes(100);
    gnomon::CasterFingerprint revision;
    root->accept(revision);
    const std::size_t before = countedNews();
    for (int frame = 0; frame < 10; ++frame) {
        revision.reset();
        root->accept(revision);
    }
    EXPECT_EQ(countedNews(), before);
    EXPECT_GT(before, 100u) << "the count does not work";
}
