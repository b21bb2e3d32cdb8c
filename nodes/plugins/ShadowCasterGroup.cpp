// SPDX-License-Identifier: MIT
#include "Fields.h"
#include "FileVersion.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowCasterGroup.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;

static bool checkCasters(const ShadowCasterGroup& group) { return group.getCasters() != Selection(); }

static bool readCasters(osgDB::InputStream& in, ShadowCasterGroup& group) {
    group.setCasters(fields::readSelection(in));
    return true;
}

static bool writeCasters(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeSelection(out, group.getCasters());
}

static bool checkLightSources(const ShadowCasterGroup& group) { return !group.getLightSources().empty(); }

static bool readLightSources(osgDB::InputStream& in, ShadowCasterGroup& group) {
    group.setLightSources(fields::readList(in, [&] { return in.readObjectOfType<osg::LightSource>(); }));
    return true;
}

static bool writeLightSources(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeList(out, group.getLightSources(), [&](const auto& source) { out.writeObject(source.get()); });
}

static bool checkLights(const ShadowCasterGroup& group) { return !group.getLights().empty(); }

static bool readLights(osgDB::InputStream& in, ShadowCasterGroup& group) {
    group.setLights(fields::readList(in, [&] {
        ShadowLight light;
        in >> light.number;
        light.inGroup = fields::readExactVector<osg::Vec4d>(in);
        return light;
    }));
    return true;
}

static bool writeLights(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeList(out, group.getLights(), [&](const ShadowLight& light) {
        out << light.number;
        fields::writeExactVector(out, light.inGroup);
    });
}

/// Direction and cutoff of each of Lights, where any of those is a spot.
static bool checkSpots(const ShadowCasterGroup& group) {
    const auto& lights = group.getLights();
    const auto isSpot = [](const ShadowLight& light) {
        return light.cutoff != ShadowLight().cutoff || light.direction != ShadowLight().direction;
    };
    return std::any_of(lights.begin(), lights.end(), isSpot);
}

static bool readSpots(osgDB::InputStream& in, ShadowCasterGroup& group) {
    const auto spots = fields::readList(in, [&] { return fields::readExactVector<osg::Vec4d>(in); });
    std::vector<ShadowLight> lights = group.getLights();
    for (std::size_t i = 0; i < std::min(lights.size(), spots.size()); ++i) {
        lights[i].direction = {spots[i].x(), spots[i].y(), spots[i].z()};
        lights[i].cutoff = spots[i].w();
    }
    group.setLights(lights);
    return true;
}

static bool writeSpots(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeList(out, group.getLights(), [&](const ShadowLight& light) {
        fields::writeExactVector(out, osg::Vec4d(light.direction, light.cutoff));
    });
}

static bool checkLightUniforms(const ShadowCasterGroup& group) { return !group.getLightUniforms().empty(); }

static bool readLightUniforms(osgDB::InputStream& in, ShadowCasterGroup& group) {
    group.setLightUniforms(fields::readList(in, [&] {
        LightUniform uniform;
        in >> uniform.number;
        in.readWrappedString(uniform.name);
        return uniform;
    }));
    return true;
}

static bool writeLightUniforms(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeList(out, group.getLightUniforms(), [&](const LightUniform& uniform) {
        out << uniform.number;
        out.writeWrappedString(uniform.name);
    });
}

static bool checkOtherCasters(const ShadowCasterGroup& group) { return !group.getCasters().others.empty(); }

static bool readOtherCasters(osgDB::InputStream& in, ShadowCasterGroup& group) {
    group.setCasters(fields::withOthers(in, group.getCasters()));
    return true;
}

static bool writeOtherCasters(osgDB::OutputStream& out, const ShadowCasterGroup& group) {
    return fields::writeOthers(out, group.getCasters());
}

/// Programs that know nothing of Gnomon, such as osgviewer, make their window after they have read the file.
static ShadowCasterGroup* newGroup() {
    askForStencilBits();
    return new ShadowCasterGroup;
}

GNOMON_WRAPPER(ShadowCasterGroup, newGroup(), "osg::Object osg::Node osg::Group", "") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    ADD_USER_SERIALIZER(Casters);
    ADD_USER_SERIALIZER(OtherCasters);
    fields::addEnum(*wrapper, "Composite", fresh->getComposite(), &MyClass::getComposite, &MyClass::setComposite,
                    {{"RELIGHT", MyClass::RELIGHT}, {"BLEND", MyClass::BLEND}});
    wrapper->addSerializer(
        new fields::ExactNumber<MyClass, float>("Dark", fresh->getDark(), &MyClass::getDark, &MyClass::setDark),
        osgDB::BaseSerializer::RW_FLOAT);
    wrapper->addSerializer(new fields::ExactNumber<MyClass, float>("OpaqueFrom", fresh->getOpaqueFrom(),
                                                                   &MyClass::getOpaqueFrom, &MyClass::setOpaqueFrom),
                           osgDB::BaseSerializer::RW_FLOAT);
    ADD_USER_SERIALIZER(LightSources);
    ADD_USER_SERIALIZER(Lights);
    ADD_USER_SERIALIZER(Spots);
    ADD_USER_SERIALIZER(LightUniforms);
    fields::addCompositorOptions<MyClass>(*wrapper);
}
