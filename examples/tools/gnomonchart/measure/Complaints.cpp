// SPDX-License-Identifier: MIT
#include "Complaints.h"

#include <algorithm>

namespace gnomon::examples {

class Complaints::Ear : public osg::NotifyHandler {
public:
    void notify(osg::NotifySeverity, const char* message) override {
        for (const char* c = message; *c; ++c) {
            if (*c != '\n') {
                _line += *c;
                continue;
            }
            keep();
            _line.clear();
        }
    }

    std::vector<std::string> lines;

private:
    void keep() {
        const bool blank = _line.find_first_not_of(" \t\r") == std::string::npos;
        if (!blank && lines.size() < most && std::find(lines.begin(), lines.end(), _line) == lines.end())
            lines.push_back(_line);
    }

    static constexpr std::size_t most = 5;

    std::string _line;
};

Complaints::Complaints() : _before(osg::getNotifyHandler()), _ear(new Ear) { osg::setNotifyHandler(_ear); }

Complaints::~Complaints() { osg::setNotifyHandler(_before); }

std::vector<std::string> Complaints::take() {
    std::vector<std::string> taken;
    taken.swap(_ear->lines);
    return taken;
}

} // namespace gnomon::examples
