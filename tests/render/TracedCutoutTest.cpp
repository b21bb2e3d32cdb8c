// SPDX-License-Identifier: MIT
// Rays pass where the alpha of a texture is clear: stripes at known places, and random boards against every triangle and texel.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowQuery.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/TexMat>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

using gnomon::TracedShadowTechnique;
using On = osg::StateAttribute;
using Wrap = osg::Texture::WrapMode;

namespace {

constexpr float reference = 0.6f;

/// One row of texels.
osg::ref_ptr<osg::Image> rowOf(const std::vector<int>& alphas, GLenum format = GL_RGBA) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(alphas.size()), 1, 1, format, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < alphas.size(); ++i)
        image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, float(alphas[i]) / 255.0f), i, 0u);
    return image;
}

osg::ref_ptr<osg::Texture2D> textureOf(osg::Image* image, osg::Texture::FilterMode filter, Wrap wrap) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::FilterMode(filter));
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::FilterMode(filter));
    for (const auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(axis, wrap);
    texture->setBorderColor(osg::Vec4d(1.0, 1.0, 1.0, 0.8));
    return texture;
}

/// A board 5 above a ground, from x = -2 to 2; s goes from -1 to 2 along it. The sun stands at 45° over +x, so that the shadow
/// lies from x = -7 to -3, beside the board. A solid plate casts up to x = -7.5. A ball far off is a body of its own, so that rays go through a tree of two levels.
struct Board {
    explicit Board(osg::Texture2D* texture, gnomon::ShadowTechnique* with = new TracedShadowTechnique)
        : technique(with) {
        geometry->setName("board");
        const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
        for (const osg::Vec3& vertex : static_cast<osg::Vec3Array&>(*geometry->getVertexArray()))
            places->push_back({vertex.x() * 0.75f + 0.5f, 0.5f});
        geometry->setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
        state().setTextureAttributeAndModes(0, texture);
        state().setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, reference));
        place->addChild(geometry);
        scene.content->addChild(place);
        scene.addShadow(technique);
        camera.emplace(scene.root, view);
    }
    osg::StateSet& state() { return *geometry->getOrCreateStateSet(); }

    /// Pixels of the next frame's ground, in the row through the middle, that are not as they are to be, but for those nearer
    /// than a tenth of a pixel to an edge of the stripes.
    int wrong(const std::function<bool(double s)>& solid) {
        const test::Picture shown = camera->frame();
        int found = 0;
        for (int x = 0; x < view.width; ++x) {
            const double pixel = 16.0 / view.width, east = (x + 0.5) * pixel - 8.0;
            const auto shadowed = [&](double ground) {
                const double s = (ground + 5.0) * 0.75 + 0.5;
                return ground < -7.5 || (s >= -1.0 && s < 2.0 && solid(s));
            };
            if (east > -2.5 || shadowed(east - 0.1 * pixel) != shadowed(east + 0.1 * pixel)) continue;
            found += (shown.at(x, view.height / 2) == test::grey(test::shadowedGround)) != shadowed(east);
        }
        return found;
    }
    bool saysSolid() const {
        const std::vector<std::string> causes = technique->diagnose();
        return std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
            return cause.find("casters with clear parts cast as if they were solid: 1, the first in 'board'") !=
                   std::string::npos;
        });
    }

    const test::View view = test::fromAbove(8.0, 200);
    test::Scene scene = test::groundScene(
        {test::moved(test::square(0.5, 11.0), {3.0, 0.0, 0.0}), test::sphere({6.0, 6.0, 1.0}, 0.9, 24)}, 9.0);
    osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(
        osg::Vec3(-2.0f, -1.0f, 0.0f), osg::Vec3(4.0f, 0.0f, 0.0f), osg::Vec3(0.0f, 2.0f, 0.0f));
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(0.0, 0.0, 5.0));
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    std::optional<test::Camera> camera;
};

const std::vector<int> stripes{255, 0, 100, 255};

/// The texels from -5 to 8, as each wrap mode of OpenGL has them; -1: the border.
std::vector<int> row(Wrap wrap) {
    switch (wrap) {
    case osg::Texture::REPEAT:
        return {3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0};
    case osg::Texture::MIRROR:
        return {3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0};
    case osg::Texture::CLAMP_TO_EDGE:
        return {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3};
    default:
        return {-1, -1, -1, -1, -1, 0, 1, 2, 3, -1, -1, -1, -1, -1};
    }
}

double alphaAt(const std::vector<int>& texels, int column) {
    const int texel = texels[std::size_t(column + 5)];
    return texel < 0 ? 0.8 : stripes[std::size_t(texel)] / 255.0;
}

TEST(TracedCutout, StripesOfATextureAreWhereItsFilterAndWrapModePutThem) {
    for (const Wrap wrap :
         {osg::Texture::REPEAT, osg::Texture::MIRROR, osg::Texture::CLAMP_TO_EDGE, osg::Texture::CLAMP_TO_BORDER}) {
        const std::vector<int> texels = row(wrap);
        SCOPED_TRACE(wrap);
        Board nearest(textureOf(rowOf(stripes), osg::Texture::NEAREST, wrap));
        EXPECT_EQ(nearest.wrong([&](double s) { return alphaAt(texels, int(std::floor(4.0 * s))) > reference; }), 0);
        Board linear(textureOf(rowOf(stripes), osg::Texture::LINEAR, wrap));
        EXPECT_EQ(linear.wrong([&](double s) {
            const double at = 4.0 * s - 0.5, share = at - std::floor(at);
            const int left = int(std::floor(at));
            return (1.0 - share) * alphaAt(texels, left) + share * alphaAt(texels, left + 1) > reference;
        }),
                  0);
        EXPECT_FALSE(nearest.saysSolid() || linear.saysSolid());
    }
}

/// OpenGL's oldest mode, which is OpenSceneGraph's default: what is beyond the image is half its edge and half the border.
TEST(TracedCutout, AClampedTextureMixesHalfTheBorderIn) {
    Board nearest(textureOf(rowOf(stripes), osg::Texture::NEAREST, osg::Texture::CLAMP));
    const std::vector<int> edge = row(osg::Texture::CLAMP_TO_EDGE);
    EXPECT_EQ(nearest.wrong([&](double s) { return alphaAt(edge, int(std::floor(4.0 * s))) > reference; }), 0);
    const osg::ref_ptr<osg::Texture2D> texture = textureOf(rowOf(stripes), osg::Texture::LINEAR, osg::Texture::CLAMP);
    texture->setBorderColor(osg::Vec4d(0.0, 0.0, 0.0, 0.4));
    Board linear(texture);
    EXPECT_EQ(linear.wrong([&](double s) {
        const double at = 4.0 * std::clamp(s, 0.0, 1.0) - 0.5, share = at - std::floor(at);
        const auto alpha = [&](int i) { return i < 0 || i > 3 ? 0.4 : stripes[std::size_t(i)] / 255.0; };
        return (1.0 - share) * alpha(int(std::floor(at))) + share * alpha(int(std::floor(at)) + 1) > reference;
    }),
              0);
}

TEST(TracedCutout, EachFunctionOfTheTestLeavesWhatItIsToLeave) {
    using F = osg::AlphaFunc;
    const std::pair<F::ComparisonFunction, std::function<bool(int)>> functions[] = {
        {F::LESS, [](int a) { return a < 102; }},    {F::LEQUAL, [](int a) { return a <= 102; }},
        {F::GEQUAL, [](int a) { return a >= 102; }}, {F::GREATER, [](int a) { return a > 102; }},
        {F::EQUAL, [](int a) { return a == 102; }},  {F::NOTEQUAL, [](int a) { return a != 102; }}};
    const std::vector<int> alphas{255, 102, 0, 101};
    for (const auto& [how, passes] : functions) {
        Board board(textureOf(rowOf(alphas), osg::Texture::NEAREST, osg::Texture::REPEAT));
        board.state().setAttribute(new F(how, 102.0f / 255.0f));
        EXPECT_EQ(board.wrong([&, pass = passes](double s) { return pass(alphas[std::size_t(4.0 * (s + 1.0)) % 4]); }),
                  0)
            << how;
    }
}

TEST(TracedCutout, FormatsOfImagesAreRead) {
    for (const GLenum format : {GL_RGBA, GL_BGRA, GL_LUMINANCE_ALPHA, GL_ALPHA}) {
        const osg::ref_ptr<osg::Image> image = rowOf(stripes, format);
        if (format == GL_BGRA) image->setInternalTextureFormat(GL_RGBA);
        Board board(textureOf(image, osg::Texture::NEAREST, osg::Texture::REPEAT));
        EXPECT_EQ(board.wrong([](double s) { return stripes[std::size_t(4.0 * (s + 1.0)) % 4] > 153; }), 0) << format;
    }
    const osg::ref_ptr<osg::Image> floats = new osg::Image;
    floats->allocateImage(4, 1, 1, GL_RGBA, GL_FLOAT);
    for (unsigned i = 0; i < 4; ++i) floats->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, float(stripes[i]) / 255.0f), i, 0u);
    Board board(textureOf(floats, osg::Texture::NEAREST, osg::Texture::REPEAT));
    EXPECT_EQ(board.wrong([](double s) { return stripes[std::size_t(4.0 * (s + 1.0)) % 4] > 153; }), 0);
}

bool isLeft(double s) { return s >= 0.0 && s < 0.5; }
bool isRight(double s) { return s >= 0.5 && s < 1.0; }

/// One camera over a light that stands still, so that the frame before is used again where nothing has changed.
TEST(TracedCutout, ChangesAreSeenInTheNextFrame) {
    for (const bool letsGo : {false, true}) {
        SCOPED_TRACE(letsGo ? "images are let go once they are drawn" : "images are kept");
        const osg::ref_ptr<osg::Texture2D> texture =
            textureOf(rowOf({255, 0}), osg::Texture::NEAREST, osg::Texture::CLAMP_TO_BORDER);
        texture->setBorderColor(osg::Vec4d());
        texture->setUnRefImageDataAfterApply(letsGo);
        Board board(texture);
        EXPECT_EQ(board.wrong(isLeft), 0);
        EXPECT_EQ(board.wrong(isLeft), 0) << "nothing has changed";
        if (letsGo) texture->setImage(nullptr); // as OpenSceneGraph does once all contexts have it
        EXPECT_EQ(board.wrong(isLeft), 0) << "the image is gone";
        texture->setImage(rowOf({0, 255}));
        EXPECT_EQ(board.wrong(isRight), 0) << "another image";
        if (letsGo) continue;
        texture->getImage()->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f), 0u, 0u);
        texture->getImage()->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 0.0f), 1u, 0u);
        texture->getImage()->dirty();
        EXPECT_EQ(board.wrong(isLeft), 0) << "an edited image";
        const osg::ref_ptr<osg::TexMat> matrix = new osg::TexMat(osg::Matrixd::translate(-0.5, 0.0, 0.0));
        board.state().setTextureAttribute(0, matrix);
        EXPECT_EQ(board.wrong(isRight), 0) << "a texture matrix";
        matrix->setMatrix(osg::Matrixd::scale(-1.0, 1.0, 1.0) * osg::Matrixd::translate(1.0, 0.0, 0.0));
        EXPECT_EQ(board.wrong(isRight), 0) << "another one, which turns it round";
        board.place->setMatrix(osg::Matrixd::scale(-1.0, 1.0, 1.0) * board.place->getMatrix());
        EXPECT_EQ(board.wrong([](double s) { return isLeft(s); }), 0) << "a mirroring transform";
        board.state().setMode(GL_ALPHA_TEST, On::OFF);
        EXPECT_EQ(board.wrong([](double) { return true; }), 0) << "no test";
    }
}

TEST(TracedCutout, WhatNoTextureTellsIsSolidAndNamed) {
    const auto all = [](double) { return true; };
    Board byVertex(textureOf(rowOf(stripes), osg::Texture::NEAREST, osg::Texture::REPEAT));
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (int i = 0; i < 4; ++i) colors->push_back({1.0f, 1.0f, 1.0f, i < 2 ? 1.0f : 0.7f});
    byVertex.geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    byVertex.state().setMode(GL_LIGHTING, On::OFF);
    EXPECT_EQ(byVertex.wrong(all), 0);
    EXPECT_TRUE(byVertex.saysSolid());
    const osg::ref_ptr<osg::Image> compressed = new osg::Image; // four times four texels, of which nothing is read
    compressed->setImage(4, 4, 1, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, GL_UNSIGNED_BYTE,
                         new unsigned char[16](), osg::Image::USE_NEW_DELETE);
    Board unread(textureOf(compressed, osg::Texture::NEAREST, osg::Texture::REPEAT));
    EXPECT_EQ(unread.wrong(all), 0);
    EXPECT_TRUE(unread.saysSolid());
}

/// Triangles anywhere, each with its own part of a texture of noise.
struct Noise {
    static constexpr int side = 8, count = 40;
    struct Corner {
        osg::Vec3d at;
        osg::Vec2d texel;
    };

    Noise() {
        std::uniform_real_distribution<float> along(-3.0f, 3.0f), up(1.0f, 5.0f), across(-2.0f, 2.0f);
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
        for (int i = 0; i < 3 * count; ++i) {
            vertices->push_back({along(random), along(random), up(random)});
            places->push_back({across(random), across(random)});
            corners.push_back({osg::Vec3d(vertices->back()), osg::Vec2d(places->back()) * side});
        }
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        for (int i = 0; i < side * side; ++i) {
            alphas.push_back(int(random() % 256));
            image->data()[4 * i + 3] = static_cast<unsigned char>(alphas.back());
        }
        geometry->setVertexArray(vertices);
        geometry->setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3 * count));
        osg::StateSet& state = *geometry->getOrCreateStateSet();
        state.setTextureAttributeAndModes(0, textureOf(image, osg::Texture::LINEAR, osg::Texture::REPEAT));
        state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    }

    double texel(int column, int row) const {
        return alphas[std::size_t((row + 4 * side) % side * side + (column + 4 * side) % side)];
    }
    /// Of the surface at a place in texels.
    double alphaAt(const osg::Vec2d& place) const {
        double sum = 0.0;
        for (int row = -2 * side - 1; row <= 2 * side; ++row) // each texel is a tent over its centre
            for (int column = -2 * side - 1; column <= 2 * side; ++column) {
                const double x = std::abs(place.x() - column - 0.5), y = std::abs(place.y() - row - 0.5);
                if (x < 1.0 && y < 1.0) sum += (1.0 - x) * (1.0 - y) * texel(column, row);
            }
        return sum / 255.0;
    }
    /// 1 where a ray meets something of them, 0 where it does not, -1 where rounding may decide.
    int blocks(const osg::Vec3d& from, const osg::Vec3d& way) const {
        bool any = false, close = false;
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const osg::Vec3d a = corners[i].at, b = corners[i + 1].at - a, c = corners[i + 2].at - a;
            const osg::Vec3d n = b ^ c, to = from - a;
            const double distance = -(to * n) / (way * n);
            const osg::Vec3d at = to + way * distance;
            const double u = ((at ^ c) * n) / (n * n), v = ((b ^ at) * n) / (n * n);
            const double inside = std::min({u, v, 1.0 - u - v});
            if (!(distance > 0.0) || inside < -1e-5) continue;
            const double alpha =
                alphaAt(corners[i].texel * (1.0 - u - v) + corners[i + 1].texel * u + corners[i + 2].texel * v);
            close = close || std::abs(alpha - 0.5) < 1e-3 || inside < 1e-5;
            any = any || alpha > 0.5;
        }
        return close ? -1 : any;
    }

    std::mt19937 random{5};
    std::vector<Corner> corners;
    std::vector<int> alphas;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
};

TEST(TracedCutout, QueriesFindOfManyTrianglesWhatEachTexelOfEachSays) {
    Noise noise;
    const osg::Vec4d sun(0.4, 0.3, 1.0, 0.0);
    const osg::ref_ptr<TracedShadowTechnique> technique = new TracedShadowTechnique;
    test::Scene scene = test::scene(sun);
    scene.content->addChild(noise.geometry);
    scene.addShadow(technique);
    const gnomon::ShadowQuery query(*technique, {0, sun});
    std::uniform_real_distribution<double> across(-4.0, 3.0);
    int asked = 0, shadowed = 0, through = 0, wrong = 0;
    while (asked < 2000) {
        const osg::Vec3d point(across(noise.random), across(noise.random), 0.0);
        const int expected = noise.blocks(point, {sun.x(), sun.y(), sun.z()});
        if (expected < 0) continue;
        ++asked;
        shadowed += expected;
        wrong += query.isLit(point) != (expected == 0);
        wrong +=
            query.exact().isBlocked(point, point + osg::Vec3d(sun.x(), sun.y(), sun.z()) * 10.0) != (expected == 1);
        through += expected == 0 && std::abs(point.x() + 1.0) < 1.5 && std::abs(point.y() + 0.8) < 1.5;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(shadowed, 300);
    EXPECT_GT(through, 5) << "in their midst";
}

} // namespace
