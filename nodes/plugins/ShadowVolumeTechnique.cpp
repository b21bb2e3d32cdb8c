// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/ShadowVolumeTechnique.h>

GNOMON_WRAPPER(ShadowVolumeTechnique, new gnomon::ShadowVolumeTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    gnomon::fields::addEnum(*wrapper, "View", fresh->getView(), &MyClass::getView, &MyClass::setView,
                            {{"NOTHING", MyClass::NOTHING}, {"VOLUMES", MyClass::VOLUMES}});
}
