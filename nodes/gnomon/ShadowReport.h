// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowDecision.h>

#include <osg/Node>

#include <string>
#include <vector>

namespace gnomon {

/// The work of a technique in the last frame in which it was drawn, over all views. For a program's own overlay.
///
///     for (const gnomon::ShadowReport& report : gnomon::shadowReports(*viewer.getSceneData()))
///         std::cout << report.text() << std::endl;
///
/// Cost
/// - Nothing, until a technique is asked for the first time. That switches its record on, from the next frame.
/// - Then two looks at the clock for each technique in each view.
struct GNOMON_EXPORT ShadowReport {
    std::string technique; ///< Class and name: "ShadowMapTechnique 'sun'".
    unsigned frame = 0;    ///< Number of that frame. 0 until a frame has been recorded; all below is then 0, too.
    unsigned lights = 0;   ///< Lights whose shadow was looked for, counted in each view.
    unsigned marks = 0;    ///< Shadows that are in sight, counted in each view. 0: nothing was drawn.
    /// Pixels of the rectangles on the screen to which the marks were confined. At least what is in shadow.
    double pixels = 0.0;
    /// Results made anew because something changed: depth maps, volumes, tiles of terrain, ray scenes. 0 in a still scene.
    unsigned passes = 0;
    double cull = 0.0; ///< Time in the cull thread, milliseconds.
    /// Time in the draw thread, milliseconds, without waiting for the GPU. Techniques of one view share it: each counts all.
    double draw = 0.0;
    std::vector<ShadowDecision> decisions; ///< Choices of an AutoShadowTechnique, see its lastDecision(). Else empty.
    /// See ShadowTechnique::diagnose(). Does not make the next frame look for those that take long to find.
    std::vector<std::string> causes;

    /// The numbers in a line: "ShadowMapTechnique 'sun': 1 light, 1 mark within 5200 pixels, 0 passes, cull 0.1 ms, draw 0.3 ms".
    std::string text() const;
};

/// The reports of all techniques at and below a node, in the order of the graph. Techniques that are switched off are
/// among them: their frame is an earlier one.
GNOMON_EXPORT std::vector<ShadowReport> shadowReports(osg::Node& scene);

} // namespace gnomon
