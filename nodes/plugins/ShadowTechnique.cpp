// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/ShadowTechnique.h>

#include <osgDB/ObjectWrapper>

using namespace gnomon;

static bool checkReceiver(const ShadowTechnique& technique) { return technique.hasReceiver(); }

static bool readReceiver(osgDB::InputStream& in, ShadowTechnique& technique) {
    technique.setReceiver(fields::readSelection(in));
    return true;
}

static bool writeReceiver(osgDB::OutputStream& out, const ShadowTechnique& technique) {
    return fields::writeSelection(out, technique.getReceiver());
}

static bool checkOtherReceiver(const ShadowTechnique& technique) { return !technique.getReceiver().others.empty(); }

static bool readOtherReceiver(osgDB::InputStream& in, ShadowTechnique& technique) {
    technique.setReceiver(fields::withOthers(in, technique.getReceiver()));
    return true;
}

static bool writeOtherReceiver(osgDB::OutputStream& out, const ShadowTechnique& technique) {
    return fields::writeOthers(out, technique.getReceiver());
}

REGISTER_OBJECT_WRAPPER(gnomon_ShadowTechnique, nullptr, gnomon::ShadowTechnique,
                        "osg::Object osg::Node osg::Geode gnomon::ShadowTechnique") {
    ADD_USER_SERIALIZER(Receiver);
    ADD_USER_SERIALIZER(OtherReceiver);
}
