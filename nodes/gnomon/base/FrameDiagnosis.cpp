// SPDX-License-Identifier: MIT
#include <gnomon/base/FrameDiagnosis.h>

#include <OpenThreads/ScopedLock>
#include <osg/FrameStamp>
#include <osg/Notify>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned firstFrames = 2; // a viewer may draw its first before it has placed the camera

/// Counts may change from frame to frame, and the cause is the same.
std::string withoutDigits(std::string text) {
    const auto isDigit = [](unsigned char letter) { return letter >= '0' && letter <= '9'; };
    text.erase(std::remove_if(text.begin(), text.end(), isDigit), text.end());
    return text;
}

} // namespace

std::vector<std::string> FrameDiagnosis::all() const {
    Lock lock(_mutex);
    _asked = true;
    _wantsSlow = true;
    return _causes;
}

std::vector<std::string> FrameDiagnosis::known() const {
    Lock lock(_mutex);
    _asked = true;
    return _causes;
}

bool FrameDiagnosis::looksForSlow(unsigned frame) {
    Lock lock(_mutex);
    if (frame != _frame) return false;
    if (_looks) return *_looks;
    _looks = _wantsSlow || _looked < firstFrames;
    if (*_looks) {
        _looked = std::min(_looked + 1, firstFrames);
        _wantsSlow = false;
        _slow.clear();
    }
    for (const std::string& sentence : _slow)
        if (_known.insert(sentence).second) _causes.push_back(sentence);
    return *_looks;
}

void FrameDiagnosis::add(unsigned frame, const std::string& who, const std::string& cause, CauseKind kind) {
    const std::string sentence = who + ": " + cause;
    if (isNewsOf(frame, sentence, kind)) // whoever is told may ask for all()
        OSG_WARN << "gnomon: " << sentence << std::endl;
}

bool FrameDiagnosis::isNewsOf(unsigned frame, const std::string& sentence, CauseKind kind) {
    Lock lock(_mutex);
    if (kind == CauseKind::Slow && std::find(_slow.begin(), _slow.end(), sentence) == _slow.end())
        _slow.push_back(sentence); // another view may have begun a frame while this one was looking
    if (frame != _frame || !_known.insert(sentence).second) return false;
    _causes.push_back(sentence);
    return !_asked && _warned.insert(withoutDigits(sentence)).second;
}

bool FrameDiagnosis::begin(unsigned frame, double time, const void* view) {
    Lock lock(_mutex);
    const bool begins = frame != _frame || time != _time || _views.count(view);
    if (begins) {
        _frame = frame;
        _time = time;
        _causes.clear();
        _known.clear();
        _looks.reset();
        _views.clear();
    }
    _views.insert(view);
    return begins;
}

FrameWork FrameDiagnosis::work() const {
    Lock lock(_mutex);
    _recorded = true;
    return _work;
}

void FrameDiagnosis::beginWork(unsigned frame, unsigned passes) {
    Lock lock(_mutex);
    _work = {};
    _work.known = true;
    _work.frame = frame;
    _work.passesBefore = passes;
}

void FrameDiagnosis::addWork(const FrameWork& work) {
    Lock lock(_mutex);
    if (!_work.known || work.frame != _work.frame) return;
    _work.lights += work.lights;
    _work.marks += work.marks;
    _work.pixels += work.pixels;
    _work.cull += work.cull;
    _work.draw += work.draw;
}

unsigned frameOf(const osg::NodeVisitor& visitor) {
    return visitor.getFrameStamp() ? visitor.getFrameStamp()->getFrameNumber() : visitor.getTraversalNumber();
}

double timeOf(const osg::NodeVisitor& visitor) {
    return visitor.getFrameStamp() ? visitor.getFrameStamp()->getReferenceTime() : 0.0;
}

std::string described(const osg::Object& node) {
    return std::string(node.className()) + (node.getName().empty() ? "" : " '" + node.getName() + "'");
}

} // namespace gnomon
