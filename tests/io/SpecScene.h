// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <osg/Geode>
#include <osg/Geometry>

#include <string>

namespace test {

/// Square of this side about the origin, z = 0, seen from above.
inline osg::ref_ptr<osg::Geode> square(const std::string& name, float side) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(-side / 2, -side / 2, 0), osg::Vec3(side, 0, 0),
                                                       osg::Vec3(0, side, 0)));
    geode->setName(name);
    return geode;
}

inline osg::ref_ptr<gnomon::ShadowCasterGroup> groupOf(osg::Node* scene) {
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(scene);
    return group;
}

} // namespace test
