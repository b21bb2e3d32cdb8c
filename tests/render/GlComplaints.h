// SPDX-License-Identifier: MIT
#pragma once
#include <support/Picture.h>

#include <memory>
#include <string>
#include <vector>

namespace test {

/// What OpenGL has against a viewer's frames: its errors, each with the text of KHR_debug. Make it before the first
/// frame, after everything else that concerns the viewer's realization; the camera goes first.
class GlComplaints {
public:
    explicit GlComplaints(Camera& camera);
    ~GlComplaints();
    std::vector<std::string> all() const;

private:
    struct Log;
    std::unique_ptr<Log> _log;
    Camera& _camera;
};

} // namespace test
