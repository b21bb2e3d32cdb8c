// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>

#include <string>

namespace test {

/// Puts the plugins that were built here before all others, for this process.
void usePluginsOfThisBuild();

/// Contents of a file of this kind ("osgt", "osgb" or "osgx") that holds the node; empty if OSG refuses to write it.
std::string written(const osg::Node& node, const std::string& kind);

/// Null if OSG refuses the contents.
osg::ref_ptr<osg::Node> loaded(const std::string& contents, const std::string& kind);

/// What OSG says of contents that it refuses.
std::string whyRefused(const std::string& contents, const std::string& kind);

/// Null if the scene in it is not a `Class`.
template <typename Class>
osg::ref_ptr<Class> loadedAs(const std::string& contents, const std::string& kind) {
    return osg::ref_ptr<Class>(dynamic_cast<Class*>(loaded(contents, kind).get()));
}

/// Written and loaded.
template <typename Class>
osg::ref_ptr<Class> throughFile(const Class& node, const std::string& kind) {
    return loadedAs<Class>(written(node, kind), kind);
}

} // namespace test
