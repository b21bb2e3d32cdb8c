// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Notify>
#include <osg/ref_ptr>

#include <algorithm>
#include <string>
#include <vector>

namespace gnomon::examples {

/// While it lives, what OpenSceneGraph has to say (shaders that do not compile, errors of OpenGL) is kept instead of
/// printed. One at a time.
class Complaints {
public:
    Complaints() { osg::setNotifyHandler(_ear); }
    ~Complaints() { osg::setNotifyHandler(_before); }
    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;

    /// Lines that were said since the last call, each once, the first five.
    std::vector<std::string> take() {
        std::vector<std::string> taken;
        taken.swap(_ear->lines);
        return taken;
    }

private:
    struct Ear : osg::NotifyHandler {
        void notify(osg::NotifySeverity, const char* message) override {
            for (const char* c = message; *c; ++c) *c == '\n' ? keep() : void(line += *c);
        }
        void keep() {
            const bool blank = line.find_first_not_of(" \t\r") == std::string::npos;
            if (!blank && lines.size() < 5 && std::find(lines.begin(), lines.end(), line) == lines.end())
                lines.push_back(line);
            line.clear();
        }
        std::vector<std::string> lines;
        std::string line;
    };

    const osg::ref_ptr<osg::NotifyHandler> _before = osg::getNotifyHandler();
    const osg::ref_ptr<Ear> _ear = new Ear;
};

} // namespace gnomon::examples
