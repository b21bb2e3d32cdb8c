// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/AutoShadowOptions.h>
#include <gnomon/Export.h>
#include <gnomon/PlanarShadowOptions.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/ShadowVolumeOptions.h>
#include <gnomon/TerrainShadowOptions.h>
#include <gnomon/TracedShadowOptions.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A technique and its settings, written as one string. The same string works in every program and in code.
///
/// Use it for command lines and configuration files. In code, set the properties of a technique directly.
///
///     gnomon::addShadows(*group, {gnomon::parseShadowSpec("planar:composite=blend,dark=0.4,receiver=floor")});
///
/// Syntax: NAME, or NAME:key=value,key=value. The names are none, planar, box, hull, map, volume, traced and auto.
/// shadowSpecHelp() lists the keys with ranges, units and defaults.
struct ShadowSpec {
    std::string text;                                      ///< The string as given.
    std::string technique = "none";                        ///< One of shadowTechniques().
    std::optional<ShadowCasterGroup::Composite> composite; ///< Default: that of a fresh ShadowCasterGroup.
    std::optional<float> dark;                             ///< See ShadowCasterGroup::setDark(). Default: the group's.
    std::optional<bool> terminatorOffset; ///< See ShadowCasterGroup::setTerminatorOffset(). Default: the group's.
    ShadowMapOptions map;                 ///< Settings of map.
    PlanarShadowOptions planar;           ///< Settings of planar.
    TerrainShadowOptions hull;            ///< Settings of hull.
    ShadowVolumeOptions volume;           ///< Settings of volume.
    TracedShadowOptions traced;           ///< Settings of traced.
    AutoShadowOptions budget;             ///< Settings of auto.
    /// Name of the nodes that receive, all of that name. Default, empty: everything for map, volume, traced and auto, else the node named "ground".
    std::string receiver;
};

/// Parses a specification string. Settings that it leaves out have their defaults.
/// @throws std::invalid_argument with one sentence that names the mistake and lists what is allowed, or says which library
///         this build lacks.
GNOMON_EXPORT ShadowSpec parseShadowSpec(const std::string& text);

/// Names of the techniques that this build can draw, and "none".
GNOMON_EXPORT std::vector<std::string> shadowTechniques();

/// Table of the techniques and their keys, ranges, units and defaults, for --help. Lines have at most 120 characters.
/// @param names  techniques to list. Default: all.
GNOMON_EXPORT std::string shadowSpecHelp(const std::vector<std::string>& names = shadowTechniques());

/// Adds the techniques of `specs` as children of `group`, and sets the group's composite.
///
/// It looks for receivers by name under the group.
/// - planar: takes the receivers' flat parts as planes. At most eight, and none below 1 % of the largest.
/// - box, hull: take the receiver as terrain.
/// - map, volume, traced, auto: take everything as receiver, unless one is named.
///
/// A ShadowedScene has a technique from the start: the first of `specs` takes its place, and "none" takes it away.
///
/// @return the techniques in the order of `specs`. "none" adds none.
/// @throws std::invalid_argument with one sentence if composites differ, or a receiver is missing or has no flat part.
GNOMON_EXPORT std::vector<osg::ref_ptr<ShadowTechnique>> addShadows(ShadowCasterGroup& group,
                                                                    const std::vector<ShadowSpec>& specs);

} // namespace gnomon
