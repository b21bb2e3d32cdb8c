// SPDX-License-Identifier: MIT
#pragma once
#include "Desktop.h"
#include "Program.h"

#include <gtest/gtest.h>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/Vec3d>

#include <algorithm>
#include <functional>
#include <vector>

namespace gnomon::testing {

/// Pixels of a picture, row by row.
using Mask = std::vector<bool>;

inline int count(const Mask& mask) { return static_cast<int>(std::count(mask.begin(), mask.end(), true)); }

/// Pixels of `a` that are not in `b`.
inline int beyond(const Mask& a, const Mask& b) {
    int result = 0;
    for (std::size_t i = 0; i < a.size(); ++i) result += a[i] && !b[i];
    return result;
}

using Arguments = std::vector<std::string>;

/// A source document's example, run as a user runs it.
class ExampleProgram : public ::testing::Test {
protected:
    explicit ExampleProgram(const std::string& program) : _program(program) {}

    Ending run(const Arguments& arguments) { return runProgram(_program, arguments, folder.path()); }
    /// Its picture. @throws std::runtime_error if there is none.
    osg::ref_ptr<osg::Image> picture(Arguments arguments);

    /// Starts it on a desktop, in the place of one that runs there.
    void start(const Arguments& arguments);
    /// The same, and hides the text once the picture stands still.
    void open(const Arguments& arguments = {});
    /// The window after something that changes it.
    Screenshot changed(const std::string& what, const std::function<void()>& act);
    Screenshot pressed(const std::string& key);
    /// Each of these keys changes the picture, and then brings it back.
    void expectSwitches(const Arguments& keys);
    void expectEscapeEndsIt();
    /// After this key the picture does not stand still.
    void expectMotionAfter(const std::string& key);

    TemporaryFolder folder;
    std::unique_ptr<Desktop> desktop;
    std::unique_ptr<ChildProcess> window;
    Screenshot withText, first; ///< of the window; first: without text.

private:
    std::string name() const { return std::filesystem::path(_program).filename(); }

    const std::string _program;
};

/// Colour of a pixel, 0 … 255, from the lower left.
osg::Vec3d colorAt(const osg::Image& image, int x, int y);
/// The largest difference in a channel.
double apart(const osg::Vec3d& a, const osg::Vec3d& b);

/// Masks are from the lower left.
Mask differing(const osg::Image& a, const osg::Image& b);
Mask maskOf(const osg::Image& a, const osg::Image& b,
            const std::function<bool(const osg::Vec3d& a, const osg::Vec3d& b)>& holds);
Mask maskOf(const osg::Image& image, const std::function<bool(const osg::Vec3d& color)>& holds);
/// Pixels where the masks differ, but for those that have a neighbour at most `margin` pixels away where `b` is another.
int misplaced(const Mask& a, const Mask& b, int width, int margin = 1);

/// Lines of sight of a picture, from the near plane.
struct Sights {
    int width, height;
    osg::Matrixd clip; ///< from world.

    /// Asks for each pixel's line, by a point on it and its way.
    Mask where(const std::function<bool(const osg::Vec3d& from, const osg::Vec3d& way)>& holds) const;
};

} // namespace gnomon::testing
