// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/TerrainShadowGeode.h>

using namespace gnomon;

GNOMON_WRAPPER(TerrainShadowGeode, new gnomon::TerrainShadowGeode, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    fields::addEnum(*wrapper, "Method", fresh->getMethod(), &MyClass::getMethod, &MyClass::setMethod,
                    {{"BOX", MyClass::BOX}, {"HULL", MyClass::HULL}, {"DRAPE", MyClass::Method(2)}}); // is refused
    wrapper->addFinishedObjectReadCallback(new fields::UnavailableWarning);
}
