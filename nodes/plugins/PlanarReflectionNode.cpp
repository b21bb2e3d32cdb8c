// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/PlanarReflectionNode.h>

using namespace gnomon;

static bool checkSurface(const PlanarReflectionNode& node) { return node.getSurface() != Selection(); }

static bool readSurface(osgDB::InputStream& in, PlanarReflectionNode& node) {
    node.setSurface(fields::readSelection(in));
    return true;
}

static bool writeSurface(osgDB::OutputStream& out, const PlanarReflectionNode& node) {
    return fields::writeSelection(out, node.getSurface());
}

static bool checkOtherSurface(const PlanarReflectionNode& node) { return !node.getSurface().others.empty(); }

static bool readOtherSurface(osgDB::InputStream& in, PlanarReflectionNode& node) {
    node.setSurface(fields::withOthers(in, node.getSurface()));
    return true;
}

static bool writeOtherSurface(osgDB::OutputStream& out, const PlanarReflectionNode& node) {
    return fields::writeOthers(out, node.getSurface());
}

GNOMON_WRAPPER(PlanarReflectionNode, new gnomon::PlanarReflectionNode, "osg::Object osg::Node osg::Group", "") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    wrapper->addSerializer(new fields::ExactVector<MyClass, osg::Vec4d>("Plane", fresh->getPlane(), &MyClass::getPlane,
                                                                        &MyClass::setPlane),
                           osgDB::BaseSerializer::RW_VEC4D);
    ADD_USER_SERIALIZER(Surface);
    ADD_USER_SERIALIZER(OtherSurface);
    wrapper->addSerializer(new fields::ExactVector<MyClass, osg::Vec3f>("Reflectance", fresh->getReflectance(),
                                                                        &MyClass::getReflectance,
                                                                        &MyClass::setReflectance),
                           osgDB::BaseSerializer::RW_VEC3F);
    ADD_BOOL_SERIALIZER(StencilCure, fresh->getStencilCure());
    fields::addCompositorOptions<MyClass>(*wrapper);
}
