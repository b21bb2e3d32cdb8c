// SPDX-License-Identifier: MIT
#define OBJECT_CAST dynamic_cast // a callback has osg::Object for a virtual base
#include "Fields.h"

#include <gnomon/HaloPulse.h>

using namespace gnomon;

GNOMON_WRAPPER(HaloPulse, new gnomon::HaloPulse, "osg::Object osg::Callback", "") {
    fields::addExact(*wrapper, "Amplitude", &MyClass::getAmplitude, &MyClass::setAmplitude);
}
