// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/HaloNode.h>

#include <osgDB/ObjectWrapper>

using namespace gnomon;

REGISTER_OBJECT_WRAPPER(gnomon_HaloNode, new gnomon::HaloNode, gnomon::HaloNode,
                        "osg::Object osg::Node osg::Group gnomon::HaloNode") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    fields::addEnum(*wrapper, "Shape", fresh->getShape(), &MyClass::getShape, &MyClass::setShape,
                    {{"WHOLE", MyClass::WHOLE}, {"PARTS", MyClass::PARTS}, {"PIXELS", MyClass::PIXELS}});
    wrapper->addSerializer(
        new fields::ExactNumber<MyClass, double>("Scale", fresh->getScale(), &MyClass::getScale, &MyClass::setScale),
        osgDB::BaseSerializer::RW_DOUBLE);
    ADD_INT_SERIALIZER(Width, fresh->getWidth());
    wrapper->addSerializer(new fields::ExactVector<MyClass, osg::Vec4f>("Color", fresh->getColor(), &MyClass::getColor,
                                                                        &MyClass::setColor),
                           osgDB::BaseSerializer::RW_VEC4F);
    ADD_BOOL_SERIALIZER(StencilCure, fresh->getStencilCure());
    fields::addCompositorOptions<MyClass>(*wrapper);
}
