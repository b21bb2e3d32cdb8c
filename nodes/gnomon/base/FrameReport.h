// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/FrameDiagnosis.h>

#include <string>

namespace gnomon {

/// Reports for one node in one frame; for what outlives the frame's cull.
struct FrameReport {
    osg::ref_ptr<FrameDiagnosis> diagnosis;
    std::string who; ///< described() of the node.
    unsigned frame = 0;

    /// Notes a cause, if there is one.
    void operator()(const std::string& cause) const {
        if (!cause.empty()) diagnosis->add(frame, who, cause);
    }
};

} // namespace gnomon
