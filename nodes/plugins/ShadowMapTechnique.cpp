// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowMapTechnique.h>

using namespace gnomon;

/// Windows made later have alpha bits.
struct AskForAlphaBits : osgDB::FinishedObjectReadCallback {
    void objectRead(osgDB::InputStream&, osg::Object& object) override {
        if (static_cast<const ShadowMapTechnique&>(object).getEdges() != ShadowMapTechnique::HARD) askForAlphaBits();
    }
};

GNOMON_WRAPPER(ShadowMapTechnique, new gnomon::ShadowMapTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    wrapper->addFinishedObjectReadCallback(new AskForAlphaBits);
    ADD_INT_SERIALIZER(Size, fresh->getSize());
    fields::addEnum(*wrapper, "Filter", fresh->getFilter(), &MyClass::getFilter, &MyClass::setFilter,
                    {{"NEAREST", MyClass::NEAREST},
                     {"BILINEAR", MyClass::BILINEAR},
                     {"BICUBIC", MyClass::BICUBIC},
                     {"FINE", MyClass::FINE}});
    ADD_INT_SERIALIZER(Cascades, fresh->getCascades());
    fields::addEnum(*wrapper, "Edges", fresh->getEdges(), &MyClass::getEdges, &MyClass::setEdges,
                    {{"HARD", MyClass::HARD}, {"SMOOTH", MyClass::SMOOTH}, {"SOFT", MyClass::SOFT}});
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("SunAngle", fresh->getSunAngle(),
                                                                    &MyClass::getSunAngle, &MyClass::setSunAngle),
                           osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("LampSize", fresh->getLampSize(),
                                                                    &MyClass::getLampSize, &MyClass::setLampSize),
                           osgDB::BaseSerializer::RW_DOUBLE);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, double>("Radius", fresh->getRadius(), &MyClass::getRadius,
                                                                    &MyClass::setRadius),
                           osgDB::BaseSerializer::RW_DOUBLE);
    ADD_INT_SERIALIZER(ProgramUnit, fresh->getProgramUnit());
    fields::addEnum(*wrapper, "View", fresh->getView(), &MyClass::getView, &MyClass::setView,
                    {{"NOTHING", MyClass::NOTHING},
                     {"MAP", MyClass::MAP},
                     {"TEXELS", MyClass::TEXELS},
                     {"CASCADES", MyClass::CASCADES}});
}
