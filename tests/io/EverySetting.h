// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Group>
#include <osg/ref_ptr>

namespace test {

/// A graph with every node of the kit, in which each setting that files keep has a value other than its default.
osg::ref_ptr<osg::Group> everySetting();

} // namespace test
