// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/PlanarShadowNode.h>

using namespace gnomon;

static bool checkPlanes(const PlanarShadowNode& node) { return !node.getPlanes().empty(); }

static bool readPlanes(osgDB::InputStream& in, PlanarShadowNode& node) {
    node.setPlanes(fields::readList(in, [&] { return fields::readExactVector<osg::Vec4d>(in); }));
    return true;
}

static bool writePlanes(osgDB::OutputStream& out, const PlanarShadowNode& node) {
    return fields::writeList(out, node.getPlanes(),
                             [&](const osg::Vec4d& plane) { fields::writeExactVector(out, plane); });
}

GNOMON_WRAPPER(PlanarShadowNode, new gnomon::PlanarShadowNode, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    ADD_USER_SERIALIZER(Planes);
    ADD_BOOL_SERIALIZER(StencilCure, fresh->getStencilCure());
    ADD_BOOL_SERIALIZER(OffsetCure, fresh->getOffsetCure());
    ADD_BOOL_SERIALIZER(ClipCure, fresh->getClipCure());
}
