// SPDX-License-Identifier: MIT
// Bitmaps that share textures: each is drawn with its own bytes, whatever sheet they are in and whose they were before.
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/terrain/TileBitmap.h>
#include <gtest/gtest.h>
#include <osg/GLExtensions>
#include <osg/Geode>
#include <support/Picture.h>

#include <set>

using gnomon::ShadowBitmap;
using gnomon::TileBitmap;

namespace {

constexpr int columns = 30, rows = 1024; // blocks: 120 rows of a sheet, so that one holds 8 bitmaps
constexpr int bitmaps = 40, apart = 300; // texels from one to the next
constexpr int wide = columns * ShadowBitmap::wide, tall = rows * ShadowBitmap::high;
constexpr int pixelsApart = 10, height = 64;

/// Bands of 64 blocks, every third of which is set.
bool isSet(int bitmap, int blockRow) { return (blockRow / 64 + bitmap) % 3 == 0; }

ShadowBitmap banded(int at, int pattern) {
    ShadowBitmap bitmap{glm::dvec2(apart * at, 0.0), 1.0, columns, rows, {}, {}, {0, 1, 2, 0, 2, 3}};
    for (int row = 0; row < rows; ++row)
        bitmap.bytes.insert(bitmap.bytes.end(), columns * ShadowBitmap::high, isSet(pattern, row) ? 255 : 0);
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(wide, 0), glm::vec2(wide, tall), glm::vec2(0, tall)})
        bitmap.vertices.emplace_back(float(apart * at) + corner.x, corner.y, 0.0f);
    return bitmap;
}

/// Bitmaps side by side, black.
class Board : public osg::Drawable {
public:
    Board() {
        setUseDisplayList(false);
        setCullingActive(false);
        for (int at = 0; at < bitmaps; ++at) set(at, at);
    }
    void set(int at, int pattern) {
        _patterns[at] = pattern;
        _bitmaps[at] = nullptr; // first of all: another's rows are what it gets
        _bitmaps[at] = new TileBitmap(banded(at, pattern), 0, _sheets);
    }
    int pattern(int at) const { return _patterns[at]; }
    void releaseSheets() { _sheets.releaseGLObjects(nullptr); }

    /// From both ends in turns, so that neighbours are in different sheets.
    void drawImplementation(osg::RenderInfo& renderInfo) const override {
        std::vector<const TileBitmap*> all;
        for (int i = 0; i < bitmaps; ++i) all.push_back(_bitmaps[i % 2 ? bitmaps - 1 - i / 2 : i / 2].get());
        osg::State& state = *renderInfo.getState();
        state.apply(_program);
        gnomon::setUniform(state, "clipFromVertex",
                           glm::dmat4(2.0 / (bitmaps * apart), 0, 0, 0, 0, 2.0 / tall, 0, 0, 0, 0, 1, 0, -1, -1, 0, 1));
        gnomon::setUniform(state, "sheet", 0);
        setCoordinates(state);
        TileBitmap::draw(renderInfo, all);
        making = _last->sheet->apply(state);
        readCoordinates(state);
    }
    mutable std::vector<osg::Vec4> coordinates; ///< that are current after it was drawn, of units 0 and 1.
    mutable unsigned making = 0;                ///< which making of a texture was drawn last.

private:
    static void setCoordinates(const osg::State& state) {
        const auto& gl = *state.get<osg::GLExtensions>();
        gl.glMultiTexCoord4f(GL_TEXTURE0, 0.1f, 0.2f, 0.3f, 0.4f);
        gl.glMultiTexCoord4f(GL_TEXTURE1, 0.5f, 0.6f, 0.7f, 0.8f);
    }
    void readCoordinates(osg::State& state) const {
        coordinates.clear();
        for (const unsigned unit : {0u, 1u}) {
            state.setActiveTextureUnit(unit);
            coordinates.emplace_back();
            glGetFloatv(GL_CURRENT_TEXTURE_COORDS, coordinates.back().ptr());
        }
    }

    gnomon::BitmapAtlases _sheets;
    const std::unique_ptr<const gnomon::AtlasRows> _last = _sheets.take(1);
    osg::ref_ptr<osg::StateSet> _program = TileBitmap::program();
    osg::ref_ptr<TileBitmap> _bitmaps[bitmaps];
    int _patterns[bitmaps];
};

test::View whole() {
    test::View view = test::fromAbove(1.0, height);
    view.width = bitmaps * pixelsApart;
    return view;
}

/// By the middles of pixels, none of which is within a twentieth of a pixel of an edge.
int wrongPixels(const test::Picture& picture, const Board& board) {
    int wrong = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < bitmaps * pixelsApart; ++x) {
            const int at = x / pixelsApart;
            const double right = (x % pixelsApart + 0.5) * apart / pixelsApart;
            const int blockRow = int((y + 0.5) * rows / height);
            const bool expected = right < wide && isSet(board.pattern(at), blockRow);
            wrong += ((picture.at(x, y) & 0xFFFFFFu) == 0) != expected;
        }
    return wrong;
}

} // namespace

TEST(BitmapAtlas, ShowsOfEachBitmapItsOwnBytes) {
    const osg::ref_ptr<Board> board = new Board;
    const osg::ref_ptr<osg::Geode> root = new osg::Geode;
    root->addDrawable(board);
    test::Camera camera(root, whole());
    EXPECT_EQ(wrongPixels(camera.frame(), *board), 0);
    for (const int at : {3, 4, 39}) board->set(at, at + 1);
    EXPECT_EQ(wrongPixels(camera.frame(), *board), 0) << "in rows that were another's";
}

TEST(BitmapAtlas, IsMadeAnewWithItsBytesOnceItWasReleased) {
    const osg::ref_ptr<Board> board = new Board;
    const osg::ref_ptr<osg::Geode> root = new osg::Geode;
    root->addDrawable(board);
    test::Camera camera(root, whole());
    camera.frame();
    camera.frame();
    EXPECT_EQ(board->making, 1u);
    board->releaseSheets();
    EXPECT_EQ(wrongPixels(camera.frame(), *board), 0);
    EXPECT_EQ(board->making, 2u);
}

TEST(BitmapAtlas, IsNoLargerThanOpenGl3Promises) {
    EXPECT_LE(std::max(gnomon::BitmapAtlas::width, gnomon::BitmapAtlas::height), 1024);
}

TEST(BitmapAtlas, LeavesCurrentTextureCoordinatesAsTheyWere) {
    const osg::ref_ptr<Board> board = new Board;
    const osg::ref_ptr<osg::Geode> root = new osg::Geode;
    root->addDrawable(board);
    test::render(root, whole());
    const std::vector<osg::Vec4> expected{{0.1f, 0.2f, 0.3f, 0.4f}, {0.5f, 0.6f, 0.7f, 0.8f}};
    EXPECT_EQ(board->coordinates, expected);
}

TEST(BitmapAtlas, GivesRowsToOneAtATime) {
    gnomon::BitmapAtlases sheets;
    std::vector<std::unique_ptr<const gnomon::AtlasRows>> taken;
    std::set<std::pair<const void*, int>> rowsTaken;
    const auto take = [&](std::size_t bytes) {
        taken.push_back(sheets.take(bytes));
        for (int i = 0; i < taken.back()->count; ++i)
            EXPECT_TRUE(rowsTaken.insert({taken.back()->sheet.get(), taken.back()->first + i}).second);
        EXPECT_GE(std::size_t(taken.back()->count) * gnomon::BitmapAtlas::width, bytes);
        EXPECT_LE(taken.back()->first + taken.back()->count, gnomon::BitmapAtlas::height);
    };
    for (std::size_t bytes = 1; bytes <= 131072; bytes += 1200) take(bytes);
    const auto* sheet = taken[20]->sheet.get();
    const int first = taken[20]->first;
    for (int i = 0; i < taken[20]->count; ++i) rowsTaken.erase({sheet, first + i});
    taken[20] = nullptr;
    take(24001); // as many rows as it had
    EXPECT_EQ(taken.back()->sheet.get(), sheet);
    EXPECT_EQ(taken.back()->first, first);
}
