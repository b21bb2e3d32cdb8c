// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/AutoShadowTechnique.h>

using namespace gnomon;

GNOMON_WRAPPER(AutoShadowTechnique, new gnomon::AutoShadowTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    wrapper->addSerializer(
        new fields::ExactNumber<MyClass, double>("Error", fresh->getError(), &MyClass::getError, &MyClass::setError),
        osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(
        new fields::ExactNumber<MyClass, double>("Time", fresh->getTime(), &MyClass::getTime, &MyClass::setTime),
        osgDB::BaseSerializer::RW_DOUBLE);
}
