// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowTechnique.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// What a specification string says: which technique, and how. The same text selects a technique everywhere.
///
///     none | planar | box | hull | drape | map | traced    the others that are planned are refused as not built yet
///     NAME:key=value,key=value               planar:composite=blend,dark=0.4,receiver=floor
struct ShadowSpec {
    std::string text;                                      ///< as given.
    std::string technique = "none";                        ///< one of shadowTechniques().
    std::optional<ShadowCasterGroup::Composite> composite; ///< not given: RELIGHT.
    std::optional<float> dark;                             ///< factor of BLEND, 0 … 1; not given: the group's 0.5.
    std::optional<double> error;                      ///< of hull and drape: in plan, scene's unit; not given: 0.1.
    std::optional<int> size;                          ///< of map: texels on a side; not given: 1024.
    std::optional<ShadowMapTechnique::Filter> filter; ///< of map; not given: BICUBIC.
    std::optional<int> cascades; ///< of map: maps of a sun at most, 0: as many as it takes; not given: 0.
    std::optional<ShadowMapTechnique::Edges> edges; ///< of map; not given: HARD.
    std::optional<double> sunAngle;                 ///< of map with soft edges: degrees; not given: 0.533.
    std::optional<double> lampSize;                 ///< of map with soft edges: diameter, scene's unit; not given: 0.
    std::optional<double> radius;                   ///< of map with soft edges: scene's unit; not given: 0.
    std::optional<ShadowMapTechnique::View> view;   ///< of map; not given: NOTHING.
    /// Name of the node that receives; empty: map and traced everything, the others the node named "ground".
    std::string receiver;
};

/// @throws std::invalid_argument, one sentence that names what is wrong and lists what is allowed.
GNOMON_EXPORT ShadowSpec parseShadowSpec(const std::string& text);

/// Names of the techniques that are built.
GNOMON_EXPORT std::vector<std::string> shadowTechniques();

/// Table of the techniques, their keys, ranges, units and defaults, for --help: lines of at most 120 characters.
/// @param names  those of them that the program has.
GNOMON_EXPORT std::string shadowSpecHelp(const std::vector<std::string>& names = shadowTechniques());

/// Adds what `specs` ask for as children of `group`, and sets its composite. The receiver is looked for under the
/// group. planar: a plane for each flat part of the receiver, up to eight, the largest first, none under 1 % of the
/// largest. box, hull, drape: the receiver is the terrain. map, traced: everything receives, unless a receiver is given.
/// @return the techniques added, in the order of `specs`; none for "none".
/// @throws std::invalid_argument, one sentence, if the specs' composites differ, the receiver is not there or has
/// nothing flat.
GNOMON_EXPORT std::vector<osg::ref_ptr<ShadowTechnique>> addShadows(ShadowCasterGroup& group,
                                                                    const std::vector<ShadowSpec>& specs);

} // namespace gnomon
