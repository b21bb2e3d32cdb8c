// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/TracedShadowTechnique.h>

#include <osgDB/ObjectWrapper>

REGISTER_OBJECT_WRAPPER(gnomon_TracedShadowTechnique, new gnomon::TracedShadowTechnique, gnomon::TracedShadowTechnique,
                        "osg::Object osg::Node osg::Geode gnomon::ShadowTechnique "
                        "gnomon::TracedShadowTechnique") {
    wrapper->addFinishedObjectReadCallback(new gnomon::fields::UnavailableWarning);
}
