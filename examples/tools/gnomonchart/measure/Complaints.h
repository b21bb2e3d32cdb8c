// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Notify>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace gnomon::examples {

/// While it lives, what OpenSceneGraph has to say (shaders that do not compile, errors of OpenGL) is kept instead of
/// printed. One at a time.
class Complaints {
public:
    Complaints();
    ~Complaints();
    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;

    /// Lines that were said since the last call, each once, the first five.
    std::vector<std::string> take();

private:
    class Ear;

    osg::ref_ptr<osg::NotifyHandler> _before;
    osg::ref_ptr<Ear> _ear;
};

} // namespace gnomon::examples
