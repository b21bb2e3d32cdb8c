// SPDX-License-Identifier: MIT
#pragma once
#include "Program.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

struct _XDisplay;

namespace gnomon::testing {

/// Pixels 0x00RRGGBB, top row first.
struct Screenshot {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;

    std::uint32_t at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
    bool operator==(const Screenshot& other) const { return width == other.width && pixels == other.pixels; }
    bool operator!=(const Screenshot& other) const { return !(*this == other); }
};

/// An X server of its own, 1024 × 768 in memory, with a keyboard that tests press.
class Desktop {
public:
    /// @throws std::runtime_error if the server does not come up.
    explicit Desktop(const std::filesystem::path& folder);
    ~Desktop();

    std::string name() const { return _name; } ///< for DISPLAY
    /// Waits for a window of this name, or with no name for any, and puts the pointer into its middle. @throws std::runtime_error
    void useWindow(const std::string& name);
    /// A letter, a digit or an X key name as "Escape".
    void press(const std::string& key);
    /// Moves the pointer from the window's middle by so many pixels to the right and down, with a mouse button held (1:
    /// left, 2: middle, 3: right), in small steps, and back without. @param with  an X key name, held down meanwhile.
    void drag(unsigned button, int right, int down, const std::string& with = "");
    Screenshot picture();
    /// The first picture for which `wanted` holds, twice the same in a row if `still`.
    /// @throws std::runtime_error with `what` if there is none within 60 s.
    Screenshot pictureWhere(const std::string& what, const std::function<bool(const Screenshot&)>& wanted,
                            bool still = true);

private:
    unsigned long firstShown() const;
    unsigned long find(unsigned long parent, const std::string& name) const;
    /// @throws std::runtime_error if there is none.
    unsigned codeOf(const std::string& key) const;

    std::unique_ptr<ChildProcess> _server;
    std::string _name;
    _XDisplay* _display = nullptr;
    unsigned long _window = 0;
};

} // namespace gnomon::testing
