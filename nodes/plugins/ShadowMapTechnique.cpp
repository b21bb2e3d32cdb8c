// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/ShadowMapTechnique.h>

#include <osgDB/ObjectWrapper>

using namespace gnomon;

REGISTER_OBJECT_WRAPPER(gnomon_ShadowMapTechnique, new gnomon::ShadowMapTechnique, gnomon::ShadowMapTechnique,
                        "osg::Object osg::Node osg::Geode gnomon::ShadowTechnique "
                        "gnomon::ShadowMapTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    ADD_INT_SERIALIZER(Size, fresh->getSize());
    BEGIN_ENUM_SERIALIZER(Filter, BICUBIC);
    ADD_ENUM_VALUE(NEAREST);
    ADD_ENUM_VALUE(BILINEAR);
    ADD_ENUM_VALUE(BICUBIC);
    ADD_ENUM_VALUE(FINE);
    END_ENUM_SERIALIZER();
    ADD_INT_SERIALIZER(Cascades, fresh->getCascades());
    BEGIN_ENUM_SERIALIZER(Edges, HARD);
    ADD_ENUM_VALUE(HARD);
    ADD_ENUM_VALUE(SMOOTH);
    ADD_ENUM_VALUE(SOFT);
    END_ENUM_SERIALIZER();
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("SunAngle", fresh->getSunAngle(),
                                                                    &MyClass::getSunAngle, &MyClass::setSunAngle),
                           osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("LampSize", fresh->getLampSize(),
                                                                    &MyClass::getLampSize, &MyClass::setLampSize),
                           osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("Radius", fresh->getRadius(), &MyClass::getRadius,
                                                                    &MyClass::setRadius),
                           osgDB::BaseSerializer::RW_DOUBLE);
    ADD_INT_SERIALIZER(ProgramUnit, fresh->getProgramUnit());
    BEGIN_ENUM_SERIALIZER(View, NOTHING);
    ADD_ENUM_VALUE(NOTHING);
    ADD_ENUM_VALUE(MAP);
    ADD_ENUM_VALUE(TEXELS);
    ADD_ENUM_VALUE(CASCADES);
    END_ENUM_SERIALIZER();
}
