// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/ShadowVolumeTechnique.h>

#include <osgDB/ObjectWrapper>

REGISTER_OBJECT_WRAPPER(gnomon_ShadowVolumeTechnique, new gnomon::ShadowVolumeTechnique, gnomon::ShadowVolumeTechnique,
                        "osg::Object osg::Node osg::Geode gnomon::ShadowTechnique "
                        "gnomon::ShadowVolumeTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    gnomon::fields::addEnum(*wrapper, "View", fresh->getView(), &MyClass::getView, &MyClass::setView,
                            {{"NOTHING", MyClass::NOTHING}, {"VOLUMES", MyClass::VOLUMES}});
}
