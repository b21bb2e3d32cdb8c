// SPDX-License-Identifier: MIT
#include "ExampleProgram.h"

#include <osgDB/ReadFile>

#include <cmath>
#include <stdexcept>

namespace gnomon::testing {

osg::ref_ptr<osg::Image> ExampleProgram::picture(Arguments arguments) {
    arguments.insert(arguments.end(), {"--out", "o.png"});
    const Ending ending = run(arguments);
    EXPECT_EQ(ending.status, 0) << ending.err;
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile((folder.path() / "o.png").string());
    std::filesystem::remove(folder.path() / "o.png");
    if (!image) throw std::runtime_error("no picture: " + ending.err);
    return image;
}

void ExampleProgram::start(const Arguments& arguments) {
    window.reset();
    if (!desktop) desktop = std::make_unique<Desktop>(folder.path());
    Arguments command = {_program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    window = std::make_unique<ChildProcess>(command, folder.path(), Arguments{"DISPLAY=" + desktop->name()});
    desktop->useWindow(name());
}

void ExampleProgram::open(const Arguments& arguments) {
    start(arguments);
    int same = 0; // a picture that changes by itself is none of g's
    Screenshot before;
    withText = desktop->pictureWhere("something is drawn and stands still", [&](const Screenshot& p) {
        const bool drawn =
            std::any_of(p.pixels.begin(), p.pixels.end(), [&](auto pixel) { return pixel != p.pixels[0]; });
        same = drawn && p == before ? same + 1 : 0;
        before = p;
        return same >= 15; // a third of a second
    });
    first = pressed("g");
}

Screenshot ExampleProgram::changed(const std::string& what, const std::function<void()>& act) {
    const Screenshot before = desktop->picture();
    act();
    return desktop->pictureWhere(what + " has changed it", [&](const Screenshot& p) { return p != before; });
}

Screenshot ExampleProgram::pressed(const std::string& key) {
    return changed(key, [&] { desktop->press(key); });
}

void ExampleProgram::expectSwitches(const Arguments& keys) {
    const Screenshot before = desktop->picture();
    for (const std::string& key : keys) {
        pressed(key);
        EXPECT_EQ(pressed(key), before) << key;
    }
}

void ExampleProgram::expectEscapeEndsIt() {
    desktop->press("Escape");
    EXPECT_EQ(window->ended(std::chrono::seconds(10)), 0) << readFile(folder.path() / (name() + ".err"));
}

void ExampleProgram::expectMotionAfter(const std::string& key) {
    desktop->press(key);
    for (int i = 0; i < 3; ++i) {
        const Screenshot before = desktop->picture();
        EXPECT_NO_THROW(desktop->pictureWhere(
            key + " lets it move", [&](const Screenshot& p) { return p != before; }, false));
    }
}

osg::Vec3d colorAt(const osg::Image& image, int x, int y) {
    const osg::Vec4 color = image.getColor(static_cast<unsigned>(x), static_cast<unsigned>(y));
    return osg::Vec3d(color.r(), color.g(), color.b()) * 255.0;
}

double apart(const osg::Vec3d& a, const osg::Vec3d& b) {
    return std::max({std::abs(a.x() - b.x()), std::abs(a.y() - b.y()), std::abs(a.z() - b.z())});
}

Mask maskOf(const osg::Image& a, const osg::Image& b,
            const std::function<bool(const osg::Vec3d&, const osg::Vec3d&)>& holds) {
    Mask mask;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x) mask.push_back(holds(colorAt(a, x, y), colorAt(b, x, y)));
    return mask;
}

Mask differing(const osg::Image& a, const osg::Image& b) {
    return maskOf(a, b, [](const osg::Vec3d& one, const osg::Vec3d& other) { return apart(one, other) > 0.5; });
}

Mask maskOf(const osg::Image& image, const std::function<bool(const osg::Vec3d&)>& holds) {
    return maskOf(image, image, [&](const osg::Vec3d& color, const osg::Vec3d&) { return holds(color); });
}

int misplaced(const Mask& a, const Mask& b, int width, int margin) {
    const int height = static_cast<int>(a.size()) / width;
    const auto at = [&](int x, int y) {
        return b[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
    };
    int result = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (a[static_cast<std::size_t>(y * width + x)] == at(x, y)) continue;
            bool edge = false;
            for (int dy = -margin; dy <= margin; ++dy)
                for (int dx = -margin; dx <= margin; ++dx) edge = edge || at(x + dx, y + dy) != at(x, y);
            result += !edge;
        }
    return result;
}

Mask Sights::where(const std::function<bool(const osg::Vec3d&, const osg::Vec3d&)>& holds) const {
    const osg::Matrixd world = osg::Matrixd::inverse(clip);
    Mask mask;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = 2.0 * (x + 0.5) / width - 1.0, v = 2.0 * (y + 0.5) / height - 1.0;
            const osg::Vec3d from = osg::Vec3d(u, v, -1.0) * world, to = osg::Vec3d(u, v, 1.0) * world;
            mask.push_back(holds(from, to - from));
        }
    return mask;
}

} // namespace gnomon::testing
