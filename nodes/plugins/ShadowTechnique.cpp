// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/ShadowTechnique.h>

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

GNOMON_WRAPPER(ShadowTechnique, nullptr, "osg::Object osg::Node osg::Geode", "") {
    ADD_USER_SERIALIZER(Receiver);
    ADD_USER_SERIALIZER(OtherReceiver);
}
