// SPDX-License-Identifier: MIT
#define OBJECT_CAST dynamic_cast // a callback has osg::Object for a virtual base
#include "Fields.h"

#include <gnomon/HaloPulse.h>

using namespace gnomon;

GNOMON_WRAPPER(HaloPulse, new gnomon::HaloPulse, "osg::Object osg::Callback", "") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("Amplitude", fresh->getAmplitude(),
                                                                    &MyClass::getAmplitude, &MyClass::setAmplitude),
                           osgDB::BaseSerializer::RW_DOUBLE);
}
