// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/TracedShadowTechnique.h>

GNOMON_WRAPPER(TracedShadowTechnique, new gnomon::TracedShadowTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    wrapper->addFinishedObjectReadCallback(new gnomon::fields::UnavailableWarning);
}
