// SPDX-License-Identifier: MIT
#include <gnomon/TracedShadowTechnique.h>

#include <osgDB/ObjectWrapper>

REGISTER_OBJECT_WRAPPER(gnomon_TracedShadowTechnique, new gnomon::TracedShadowTechnique, gnomon::TracedShadowTechnique,
                        "osg::Object osg::Node osg::Geode gnomon::ShadowTechnique "
                        "gnomon::TracedShadowTechnique") {
    static_cast<void>(wrapper); // it has no property of its own
}
