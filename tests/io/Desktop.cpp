// SPDX-License-Identifier: MIT
#include "Desktop.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

#include <chrono>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace gnomon::testing {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds pause{20};
constexpr milliseconds limit{60000}; // under a sanitizer, beside other work, a picture has taken more than ten seconds

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// What is written into a pipe, up to the end of a line.
std::string readLine(int pipe, milliseconds time) {
    std::string line;
    for (const Clock::time_point end = Clock::now() + time; Clock::now() < end;) {
        pollfd ready{pipe, POLLIN, 0};
        char letter = 0;
        if (poll(&ready, 1, int(pause.count())) == 0) continue;
        if (read(pipe, &letter, 1) != 1 || letter == '\n') return line;
        line += letter;
    }
    return "";
}

} // namespace

Desktop::Desktop(const std::filesystem::path& folder) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("no pipe can be made");
    _server =
        std::make_unique<ChildProcess>(std::vector<std::string>{XVFB, "-displayfd", std::to_string(ends[1]), "-screen",
                                                                "0", "1024x768x24", "-nolisten", "tcp"},
                                       folder, std::vector<std::string>{}, ends[1]);
    close(ends[1]);
    const std::string number = readLine(ends[0], limit);
    close(ends[0]);
    if (number.empty()) fail("Xvfb does not come up");
    _name = ":" + number;
    _display = XOpenDisplay(_name.c_str());
    if (!_display) fail("the display " + _name + " cannot be opened");
}

Desktop::~Desktop() {
    if (_display) XCloseDisplay(_display);
}

unsigned long Desktop::find(unsigned long parent, const std::string& name) const {
    char* title = nullptr;
    XFetchName(_display, parent, &title);
    const bool same = title && name == title;
    XFree(title);
    if (same) return parent;
    Window root = 0, above = 0, *children = nullptr, found = 0;
    unsigned count = 0;
    XQueryTree(_display, parent, &root, &above, &children, &count);
    for (unsigned i = 0; i < count && !found; ++i) found = find(children[i], name);
    XFree(children);
    return found;
}

unsigned long Desktop::firstShown() const {
    Window root = 0, above = 0, *children = nullptr, found = 0;
    unsigned count = 0;
    XQueryTree(_display, DefaultRootWindow(_display), &root, &above, &children, &count);
    for (unsigned i = 0; i < count && !found; ++i) {
        XWindowAttributes window{};
        if (XGetWindowAttributes(_display, children[i], &window) && window.map_state == IsViewable) found = children[i];
    }
    XFree(children);
    return found;
}

void Desktop::useWindow(const std::string& name) {
    const Window root = DefaultRootWindow(_display);
    const auto isFound = [&] { return (_window = name.empty() ? firstShown() : find(root, name)) != 0; };
    if (!waitFor(limit, isFound)) fail("no window " + name + " appears");
    const Screenshot now = picture();
    XTestFakeMotionEvent(_display, 0, 50 + now.width / 2, 50 + now.height / 2, 0);
    XFlush(_display);
}

unsigned Desktop::codeOf(const std::string& key) const {
    const KeyCode code = XKeysymToKeycode(_display, XStringToKeysym(key.c_str()));
    if (code == 0) fail("there is no key " + key);
    return code;
}

void Desktop::press(const std::string& key) {
    for (const int down : {True, False}) XTestFakeKeyEvent(_display, codeOf(key), down, 0);
    XFlush(_display);
}

void Desktop::drag(unsigned button, int right, int down, const std::string& with) {
    constexpr int steps = 8;
    const auto wait = [this] {
        XFlush(_display);
        std::this_thread::sleep_for(2 * pause);
    };
    if (!with.empty()) XTestFakeKeyEvent(_display, codeOf(with), True, 0);
    XTestFakeButtonEvent(_display, button, True, 0);
    wait();
    for (int step = 0; step < steps; ++step) {
        XTestFakeRelativeMotionEvent(_display, right * (step + 1) / steps - right * step / steps,
                                     down * (step + 1) / steps - down * step / steps, 0);
        wait();
    }
    std::this_thread::sleep_for(20 * pause); // what is let go while it moves is thrown on by OSG's manipulators
    XTestFakeButtonEvent(_display, button, False, 0);
    if (!with.empty()) XTestFakeKeyEvent(_display, codeOf(with), False, 0);
    wait();
    XTestFakeRelativeMotionEvent(_display, -right, -down, 0);
    XFlush(_display);
}

/// While a window is made to fill the screen a part of it lies beside the screen, of which there is no picture.
static int noPicture(Display*, XErrorEvent*) { return 0; }

Screenshot Desktop::picture() {
    XWindowAttributes place{};
    XImage* image = nullptr;
    XSync(_display, False);
    const XErrorHandler before = XSetErrorHandler(noPicture);
    waitFor(limit, [&] {
        XGetWindowAttributes(_display, _window, &place);
        image = XGetImage(_display, _window, 0, 0, unsigned(place.width), unsigned(place.height), AllPlanes, ZPixmap);
        return image != nullptr;
    });
    XSetErrorHandler(before);
    if (!image) fail("the window has no picture");
    Screenshot result{place.width, place.height, {}};
    for (int y = 0; y < place.height; ++y)
        for (int x = 0; x < place.width; ++x)
            result.pixels.push_back(static_cast<std::uint32_t>(XGetPixel(image, x, y) & 0xffffffu));
    XDestroyImage(image);
    return result;
}

Screenshot Desktop::pictureWhere(const std::string& what, const std::function<bool(const Screenshot&)>& wanted,
                                 bool still) {
    Screenshot before, now = picture();
    const bool seen = waitFor(limit, [&] {
        before = now;
        now = picture();
        return wanted(now) && (!still || now == before);
    });
    if (!seen) fail("within 60 s there was no picture where " + what);
    return now;
}

} // namespace gnomon::testing
