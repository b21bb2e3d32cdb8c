// SPDX-License-Identifier: MIT
#include <gnomon/base/FrameDiagnosis.h>

#include <OpenThreads/ScopedLock>
#include <osg/FrameStamp>
#include <osg/Notify>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

std::vector<std::string> FrameDiagnosis::all() const {
    Lock lock(_mutex);
    return _causes;
}

void FrameDiagnosis::add(unsigned frame, const std::string& who, const std::string& cause) {
    Lock lock(_mutex);
    if (frame != _frame) return;
    const std::string sentence = who + ": " + cause;
    if (!_known.insert(sentence).second) return;
    _causes.push_back(sentence);
    OSG_INFO << "gnomon: " << sentence << std::endl;
}

void FrameDiagnosis::begin(unsigned frame, const void* view) {
    Lock lock(_mutex);
    if (frame != _frame || _views.count(view)) {
        _frame = frame;
        _causes.clear();
        _known.clear();
        _views.clear();
    }
    _views.insert(view);
}

unsigned frameOf(const osg::NodeVisitor& visitor) {
    return visitor.getFrameStamp() ? visitor.getFrameStamp()->getFrameNumber() : visitor.getTraversalNumber();
}

std::string described(const osg::Object& node) {
    return std::string(node.className()) + (node.getName().empty() ? "" : " '" + node.getName() + "'");
}

} // namespace gnomon
