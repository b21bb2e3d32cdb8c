// SPDX-License-Identifier: MIT
#pragma once
#include <osgViewer/ViewerEventHandlers>

namespace gnomon {

/// Adds two lines to OSG's statistics, which the key `s` shows: what shadows cost in cull, and what in draw.
///
///     osg::ref_ptr<osgViewer::StatsHandler> statistics = new osgViewer::StatsHandler;
///     gnomon::addShadowStats(*statistics);
///     viewer.addEventHandler(statistics);
///
/// While a camera's statistics collect "rendering", as that key asks for, or "gnomon", Gnomon writes for each frame, into
/// those of the camera and those of its view:
///
/// - "Shadow cull begin time", "Shadow cull end time", "Shadow draw begin time", "Shadow draw end time": seconds
/// - "Shadow cull time taken", "Shadow draw time taken": seconds, without waiting for the GPU
/// - "Shadow marks": shadows of a light that are in sight
///
/// An osgViewer::Viewer shows its view's. An osgViewer::CompositeViewer has statistics of its own: hand it those of a view
/// by setViewerStats().
///
/// Only this header needs osgViewer. Cost: none while nothing is collected.
inline void addShadowStats(osgViewer::StatsHandler& statistics) {
    const osg::Vec4 text(0.8f, 0.8f, 0.5f, 1.0f), bar(0.8f, 0.8f, 0.5f, 0.5f);
    const auto add = [&](const char* label, const char* taken, const char* begin, const char* end) {
        constexpr float milliseconds = 1000.0f, unbounded = 0.0f;
        statistics.addUserStatsLine(label, text, bar, taken, milliseconds, true, false, begin, end, unbounded);
    };
    // short: OSG writes the number behind the label, and the bars over what is longer
    add("Sh. cull", "Shadow cull time taken", "Shadow cull begin time", "Shadow cull end time");
    add("Sh. draw", "Shadow draw time taken", "Shadow draw begin time", "Shadow draw end time");
}

} // namespace gnomon
