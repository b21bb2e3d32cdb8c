// SPDX-License-Identifier: MIT
#pragma once
#include <OpenThreads/Mutex>
#include <osg/NodeVisitor>

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace gnomon {

/// What a technique does in a frame, over all views. See ShadowReport.
struct FrameWork {
    bool known = false; ///< a frame has been recorded.
    unsigned frame = 0;
    unsigned lights = 0, marks = 0;
    double pixels = 0.0;
    double cull = 0.0, draw = 0.0; ///< milliseconds.
    unsigned passesBefore = 0;     ///< the technique's count when the frame began.
};

/// Slow: it takes too long to look for it in each frame, see FrameDiagnosis::looksForSlow().
enum class CauseKind { Quick, Slow };

/// What became of a node in the last frame, over all views: why it could not draw what it is for, and, once somebody has
/// asked, what it did.
///
/// Threads any number.
class FrameDiagnosis : public osg::Referenced {
public:
    /// One text for each cause: what is wrong, then what to do. Empty if all is well. Whoever asks is not warned, and
    /// the next frame looks for slow causes.
    std::vector<std::string> all() const;
    /// The same, but the next frame does not look for slow causes.
    std::vector<std::string> known() const;
    /// Whether this frame looks for slow causes, in all of its views: the first two that ask this do, so that a program is warned
    /// that never asks for all(), and the one after each call of all(). In the others the slow causes that were found last are
    /// causes of this frame, too.
    bool looksForSlow(unsigned frame);
    /// Notes a cause; repeated ones count once, those of frames before the last none. Warns by osg::notify() of each that
    /// is new, numbers aside, until somebody asks for all().
    /// @param who  described() of the node.
    void add(unsigned frame, const std::string& who, const std::string& cause, CauseKind kind = CauseKind::Quick);
    /// Forgets the causes of frames before this one: its number or its time is another one, as that of a viewer that
    /// counts alike, or `view` (any address that stands for it) has been met in it before, as where nobody counts frames.
    /// @param time  see timeOf().
    /// @return true if a frame begins with it.
    bool begin(unsigned frame, double time, const void* view);

    /// What was recorded. The first call starts the record, from the next frame on.
    FrameWork work() const;
    /// True if somebody has asked for work().
    bool isRecorded() const { return _recorded; }
    /// Begins a frame's record. @param passes  of the technique so far.
    void beginWork(unsigned frame, unsigned passes);
    /// Adds to the record of this frame; nothing if another has begun.
    void addWork(const FrameWork& work);

protected:
    ~FrameDiagnosis() override = default;

private:
    /// Notes it. @return whether to warn of it.
    bool isNewsOf(unsigned frame, const std::string& sentence, CauseKind kind);

    mutable OpenThreads::Mutex _mutex;
    mutable bool _asked = false;
    mutable bool _wantsSlow = false; ///< somebody has asked for all() since a frame has looked for slow causes.
    mutable std::atomic<bool> _recorded{false};
    FrameWork _work;
    std::vector<std::string> _causes;
    std::unordered_set<std::string> _known; ///< the same.
    std::set<std::string> _warned;          ///< without their digits.
    std::vector<std::string> _slow;         ///< causes, found last.
    std::optional<bool> _looks;             ///< for slow causes, in this frame; nullopt: not asked yet.
    unsigned _looked = 0;                   ///< frames that have looked for them, up to the first two.
    unsigned _frame = 0;
    double _time = 0.0;
    std::set<const void*> _views; ///< met in that frame.
};

/// The frame that a traversal belongs to; where nobody counts frames, its own number.
unsigned frameOf(const osg::NodeVisitor& visitor);
/// Seconds, as the viewer of the frame counts them: the same in all of its views. 0 where nobody counts.
double timeOf(const osg::NodeVisitor& visitor);

/// "PlanarShadowNode 'floor'": what a cause begins with.
std::string described(const osg::Object& node);

/// Reports for one node in one frame; for what outlives the frame's cull.
struct FrameReport {
    osg::ref_ptr<FrameDiagnosis> diagnosis;
    std::string who; ///< described() of the node.
    unsigned frame = 0;

    /// Notes a cause, if there is one.
    void operator()(const std::string& cause, CauseKind kind = CauseKind::Quick) const {
        if (!cause.empty()) diagnosis->add(frame, who, cause, kind);
    }
};

} // namespace gnomon
