// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/TerrainShadowGeode.h>

using namespace gnomon;
using fields::readExactVector;
using fields::writeExactVector;

static bool checkObjectPos(const TerrainShadowGeode& geode) { return geode.getObjectPos() != osg::Vec3d(); }

static bool readObjectPos(osgDB::InputStream& in, TerrainShadowGeode& geode) {
    geode.setObjectPos(readExactVector<osg::Vec3d>(in));
    return true;
}

static bool writeObjectPos(osgDB::OutputStream& out, const TerrainShadowGeode& geode) {
    writeExactVector(out, geode.getObjectPos());
    out << std::endl;
    return true;
}

static bool checkObjectBounds(const TerrainShadowGeode& geode) { return geode.getObjectBounds().valid(); }

static bool readObjectBounds(osgDB::InputStream& in, TerrainShadowGeode& geode) {
    const auto low = readExactVector<osg::Vec3d>(in);
    geode.setObjectBounds({low, readExactVector<osg::Vec3d>(in)});
    return true;
}

static bool writeObjectBounds(osgDB::OutputStream& out, const TerrainShadowGeode& geode) {
    writeExactVector(out, geode.getObjectBounds()._min);
    writeExactVector(out, geode.getObjectBounds()._max);
    out << std::endl;
    return true;
}

GNOMON_WRAPPER(TerrainShadowGeode, new gnomon::TerrainShadowGeode, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    fields::addEnum(*wrapper, "Method", fresh->getMethod(), &MyClass::getMethod, &MyClass::setMethod,
                    {{"BOX", MyClass::BOX}, {"HULL", MyClass::HULL}, {"DRAPE", MyClass::DRAPE}});
    wrapper->addSerializer(
        new fields::ExactNumber<MyClass, double>("Error", fresh->getError(), &MyClass::getError, &MyClass::setError),
        osgDB::BaseSerializer::RW_DOUBLE);
    ADD_OBJECT_SERIALIZER(ObjectGraphic, osg::Node, nullptr);
    ADD_USER_SERIALIZER(ObjectPos);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("ObjectOrientation", fresh->getObjectOrientation(),
                                                                    &MyClass::getObjectOrientation,
                                                                    &MyClass::setObjectOrientation),
                           osgDB::BaseSerializer::RW_DOUBLE);
    ADD_USER_SERIALIZER(ObjectBounds);
    wrapper->addFinishedObjectReadCallback(new fields::UnavailableWarning);
}
