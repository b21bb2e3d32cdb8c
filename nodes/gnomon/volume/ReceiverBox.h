// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ViewFrame.h>

#include <glm/vec3.hpp>

namespace gnomon {

/// Bounds of all that can receive in a view, in the scene. Not finite if they are not known; low > high if there is nothing.
struct ReceiverBox {
    glm::dvec3 low, high;

    /// True if `other` is within, and not much smaller.
    bool fits(const ReceiverBox& other) const;
    /// With room to move in.
    ReceiverBox grown() const;
    bool operator==(const ReceiverBox& other) const { return low == other.low && high == other.high; }
};

ReceiverBox receiversOf(const ViewFrame& view, const SceneFrame& scene);

} // namespace gnomon
