// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/HaloNode.h>

using namespace gnomon;

GNOMON_WRAPPER(HaloNode, new gnomon::HaloNode, "osg::Object osg::Node osg::Group", "") {
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
