// SPDX-License-Identifier: MIT
#define OBJECT_CAST dynamic_cast // a callback has osg::Object for a virtual base
#include "Fields.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/SceneProps.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

#include <osgDB/OutputStream>
#include <osgDB/Serializer>

#include <algorithm>
#include <iterator>

using namespace gnomon;

// Versions of the kit's part of scene files.
//
// In binary files each object of the kit begins with a mark and a version. OSG's own header cannot tell it, because the
// programs that write files do not know the kit. Text files name their properties and need no version. A property that
// is added belongs into a new version, here 7, and `fileVersion` becomes 7:
//
//     {
//         UPDATE_TO_VERSION_SCOPED(7)
//         ADD_BOOL_SERIALIZER(Tint, fresh->getTint());
//     }
namespace {

/// OSG's word for the library that a version belongs to.
constexpr const char* fileDomain = "gnomon";
constexpr int fileVersion = 6;  ///< The version that is written.
constexpr int firstVersion = 3; ///< The oldest that is read.
constexpr const char* faultsAreGone = "the faults of earlier programs are not drawn";
constexpr char mark[] = {'g', 'n', 'm', 'n'}; // files without it have switches, enumerators or numbers here

/// The stream below, which OSG shows to none but classes that inherit.
struct Below : osgDB::InputStream {
    static std::istream& of(osgDB::InputStream& in) { return *(in.*&Below::_in)->getStream(); }
};

/// A place in a file to go back to.
class Bookmark {
public:
    explicit Bookmark(osgDB::InputStream& in) : _file(Below::of(in)), _place(_file.tellg()) {}

    void goBack() const {
        _file.clear(); // the end may have been met
        _file.seekg(_place);
    }

private:
    std::istream& _file;
    const std::istream::pos_type _place;
};

bool isMarked(osgDB::InputStream& in) {
    char found[std::size(mark)] = {};
    const Bookmark here(in);
    in.readCharArray(found, std::size(mark));
    const bool is = std::equal(std::begin(mark), std::end(mark), found);
    if (!is) here.goBack();
    return is;
}

/// Tells the stream the version of the properties that follow.
class VersionSerializer : public osgDB::BaseSerializer {
public:
    VersionSerializer() : BaseSerializer(READ_WRITE_PROPERTY) {}
    const std::string& getName() const override { return _name; }

    bool read(osgDB::InputStream& in, osg::Object&) override {
        int version = fileVersion; // text may have any property
        if (in.isBinary()) {
            version = 0;
            if (isMarked(in)) in >> version;
        }
        if (version > fileVersion)
            in.throwException("gnomon: the file is of version " + std::to_string(version) +
                              ", which this Gnomon does not know. Update Gnomon, or save the file as .osgt.");
        if (version < firstVersion)
            in.throwException(
                "gnomon: the file is of a version before the first release. Save it as .osgt with the Gnomon "
                "that wrote it.");
        in.setFileVersion(fileDomain, version);
        return true;
    }

    bool write(osgDB::OutputStream& out, const osg::Object&) override {
        out.setFileVersion(fileDomain, fileVersion);
        if (out.isBinary()) {
            out.writeCharArray(mark, std::size(mark));
            out << fileVersion;
        }
        return true;
    }

private:
    const std::string _name = "FileVersion";
};

} // namespace

// No class of its own: what every class of the kit has before its properties.
namespace FileVersionFields {
REGISTER_CUSTOM_OBJECT_WRAPPER2(gnomon, gnomon_FileVersion, nullptr, osg::Object, "gnomon::FileVersion", "") {
    static_cast<void>(domain);
    wrapper->addSerializer(new VersionSerializer, osgDB::BaseSerializer::RW_UNDEFINED);
}
} // namespace FileVersionFields

static void writeItem(osgDB::OutputStream& out, const osg::ref_ptr<osg::LightSource>& source) {
    out.writeObject(source.get());
}

static void readItem(osgDB::InputStream& in, osg::ref_ptr<osg::LightSource>& source) {
    source = in.readObjectOfType<osg::LightSource>();
}

static void writeItem(osgDB::OutputStream& out, const ShadowLight& light) {
    out << light.number;
    fields::writeExactVector(out, light.inGroup);
}

static void readItem(osgDB::InputStream& in, ShadowLight& light) {
    in >> light.number;
    light.inGroup = fields::readExactVector<osg::Vec4d>(in);
}

static void writeItem(osgDB::OutputStream& out, const LightUniform& uniform) {
    out << uniform.number;
    out.writeWrappedString(uniform.name);
}

static void readItem(osgDB::InputStream& in, LightUniform& uniform) {
    in >> uniform.number;
    in.readWrappedString(uniform.name);
}

static void writeItem(osgDB::OutputStream& out, const MatrixUniform& uniform) {
    out << int(uniform.kind);
    out.writeWrappedString(uniform.name);
}

static void readItem(osgDB::InputStream& in, MatrixUniform& uniform) {
    int kind = 0;
    in >> kind;
    uniform.kind = MatrixUniform::Kind(kind);
    in.readWrappedString(uniform.name);
}

static void writeItem(osgDB::OutputStream& out, const osg::Vec4d& plane) { fields::writeExactVector(out, plane); }

static void readItem(osgDB::InputStream& in, osg::Vec4d& plane) { plane = fields::readExactVector<osg::Vec4d>(in); }

/// Adds a property that is a list of items as above, kept where it is not empty.
template <typename Class, auto get, auto set>
static void addList(osgDB::ObjectWrapper& wrapper, const char* property) {
    const auto check = [](const Class& node) { return !(node.*get)().empty(); };
    const auto read = [](osgDB::InputStream& in, Class& node) {
        (node.*set)(fields::readList(in, [&] {
            typename std::decay_t<decltype((node.*get)())>::value_type item;
            readItem(in, item);
            return item;
        }));
        return true;
    };
    const auto write = [](osgDB::OutputStream& out, const Class& node) {
        return fields::writeList(out, (node.*get)(), [&](const auto& item) { writeItem(out, item); });
    };
    wrapper.addSerializer(new osgDB::UserSerializer<Class>(property, check, read, write),
                          osgDB::BaseSerializer::RW_USER);
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

/// Programs that know nothing of Gnomon, such as osgviewer, make their window after they have read the file.
static ShadowCasterGroup* newGroup() {
    askForStencilBits();
    return new ShadowCasterGroup;
}

GNOMON_WRAPPER(ShadowCasterGroup, newGroup(), "osg::Object osg::Node osg::Group", "") {
    fields::addSelection<MyClass, &MyClass::getCasters, &MyClass::setCasters>(*wrapper, "Casters");
    fields::addEnum(*wrapper, "Composite", &MyClass::getComposite, &MyClass::setComposite,
                    {{"RELIGHT", MyClass::RELIGHT}, {"BLEND", MyClass::BLEND}});
    fields::addExact(*wrapper, "Dark", &MyClass::getDark, &MyClass::setDark);
    fields::addExact(*wrapper, "OpaqueFrom", &MyClass::getOpaqueFrom, &MyClass::setOpaqueFrom);
    addList<MyClass, &MyClass::getLightSources, &MyClass::setLightSources>(*wrapper, "LightSources");
    addList<MyClass, &MyClass::getLights, &MyClass::setLights>(*wrapper, "Lights");
    ADD_USER_SERIALIZER(Spots);
    addList<MyClass, &MyClass::getLightUniforms, &MyClass::setLightUniforms>(*wrapper, "LightUniforms");
    fields::addCompositorOptions<MyClass>(*wrapper);
    {
        UPDATE_TO_VERSION_SCOPED(4)
        fields::addEnum(*wrapper, "Clipping", &MyClass::getClipping, &MyClass::setClipping,
                        {{"GRAPH", MyClass::GRAPH}, {"ALL", MyClass::ALL}, {"NONE", MyClass::NONE}});
    }
    {
        UPDATE_TO_VERSION_SCOPED(5)
        ADD_BOOL_SERIALIZER(TerminatorOffset, true);
    }
    {
        UPDATE_TO_VERSION_SCOPED(6)
        addList<MyClass, &MyClass::getMatrixUniforms, &MyClass::setMatrixUniforms>(*wrapper, "MatrixUniforms");
    }
}

/// Windows made later have alpha bits.
template <typename Technique>
struct AskForAlphaBits : osgDB::FinishedObjectReadCallback {
    void objectRead(osgDB::InputStream&, osg::Object& object) override {
        if (static_cast<const Technique&>(object).getOptions().fades()) askForAlphaBits();
    }
};

/// Of techniques that are exact.
template <typename Technique>
void addEdges(osgDB::ObjectWrapper& wrapper) {
    wrapper.addFinishedObjectReadCallback(new AskForAlphaBits<Technique>);
    fields::addEnum(wrapper, "Edges", &Technique::getEdges, &Technique::setEdges,
                    {{"HARD", Technique::HARD}, {"SMOOTH", Technique::SMOOTH}});
}

GNOMON_WRAPPER(ShadowTechnique, nullptr, "osg::Object osg::Node osg::Geode", "") {
    fields::addSelection<MyClass, &MyClass::getReceiver, &MyClass::setReceiver>(*wrapper, "Receiver");
}

GNOMON_WRAPPER(PlanarShadowNode, new gnomon::PlanarShadowNode, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    addList<MyClass, &MyClass::getPlanes, &MyClass::setPlanes>(*wrapper, "Planes");
    addEdges<MyClass>(*wrapper);
    fields::addGone(*wrapper, "StencilCure", true, faultsAreGone);
    fields::addGone(*wrapper, "OffsetCure", true, faultsAreGone);
    fields::addGone(*wrapper, "ClipCure", true, faultsAreGone);
}

GNOMON_WRAPPER(ShadowMapTechnique, new gnomon::ShadowMapTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    wrapper->addFinishedObjectReadCallback(new AskForAlphaBits<MyClass>);
    ADD_INT_SERIALIZER(Size, fresh->getSize());
    fields::addEnum(*wrapper, "Filter", &MyClass::getFilter, &MyClass::setFilter,
                    {{"NEAREST", MyClass::NEAREST},
                     {"BILINEAR", MyClass::BILINEAR},
                     {"BICUBIC", MyClass::BICUBIC},
                     {"FINE", MyClass::FINE}});
    ADD_INT_SERIALIZER(Cascades, fresh->getCascades());
    fields::addEnum(*wrapper, "Edges", &MyClass::getEdges, &MyClass::setEdges,
                    {{"HARD", MyClass::HARD}, {"SMOOTH", MyClass::SMOOTH}, {"SOFT", MyClass::SOFT}});
    fields::addExact(*wrapper, "SunAngle", &MyClass::getSunAngle, &MyClass::setSunAngle);
    fields::addExact(*wrapper, "LampSize", &MyClass::getLampSize, &MyClass::setLampSize);
    fields::addExact(*wrapper, "Radius", &MyClass::getRadius, &MyClass::setRadius);
    ADD_INT_SERIALIZER(ProgramUnit, fresh->getProgramUnit());
    fields::addEnum(*wrapper, "View", &MyClass::getView, &MyClass::setView,
                    {{"NOTHING", MyClass::NOTHING},
                     {"MAP", MyClass::MAP},
                     {"TEXELS", MyClass::TEXELS},
                     {"CASCADES", MyClass::CASCADES}});
}

GNOMON_WRAPPER(ShadowVolumeTechnique, new gnomon::ShadowVolumeTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    addEdges<MyClass>(*wrapper);
    fields::addEnum(*wrapper, "View", &MyClass::getView, &MyClass::setView,
                    {{"NOTHING", MyClass::NOTHING}, {"VOLUMES", MyClass::VOLUMES}});
}

GNOMON_WRAPPER(TerrainShadowGeode, new gnomon::TerrainShadowGeode, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    fields::addEnum(*wrapper, "Method", &MyClass::getMethod, &MyClass::setMethod,
                    {{"BOX", MyClass::BOX}, {"HULL", MyClass::HULL}, {"DRAPE", MyClass::Method(2)}}); // is refused
    addEdges<MyClass>(*wrapper);
    wrapper->addFinishedObjectReadCallback(new fields::UnavailableWarning);
}

GNOMON_WRAPPER(TracedShadowTechnique, new gnomon::TracedShadowTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    addEdges<MyClass>(*wrapper);
    wrapper->addFinishedObjectReadCallback(new fields::UnavailableWarning);
}

GNOMON_WRAPPER(AutoShadowTechnique, new gnomon::AutoShadowTechnique, "osg::Object osg::Node osg::Geode",
               "gnomon::ShadowTechnique") {
    fields::addExact(*wrapper, "Error", &MyClass::getError, &MyClass::setError);
    fields::addGone(*wrapper, "Time", 0.0, "auto keeps the error alone");
}

GNOMON_WRAPPER(HaloNode, new gnomon::HaloNode, "osg::Object osg::Node osg::Group", "") {
    const osg::ref_ptr<const MyClass> fresh = new MyClass;
    fields::addEnum(*wrapper, "Shape", &MyClass::getShape, &MyClass::setShape,
                    {{"WHOLE", MyClass::WHOLE}, {"PARTS", MyClass::PARTS}, {"PIXELS", MyClass::PIXELS}});
    fields::addExact(*wrapper, "Scale", &MyClass::getScale, &MyClass::setScale);
    ADD_INT_SERIALIZER(Width, fresh->getWidth());
    fields::addExact(*wrapper, "Color", &MyClass::getColor, &MyClass::setColor);
    fields::addGone(*wrapper, "StencilCure", true, faultsAreGone);
    fields::addCompositorOptions<MyClass>(*wrapper);
}

GNOMON_WRAPPER(HaloPulse, new gnomon::HaloPulse, "osg::Object osg::Callback", "") {
    fields::addExact(*wrapper, "Amplitude", &MyClass::getAmplitude, &MyClass::setAmplitude);
}

GNOMON_WRAPPER(PlanarReflectionNode, new gnomon::PlanarReflectionNode, "osg::Object osg::Node osg::Group", "") {
    fields::addExact(*wrapper, "Plane", &MyClass::getPlane, &MyClass::setPlane);
    fields::addSelection<MyClass, &MyClass::getSurface, &MyClass::setSurface>(*wrapper, "Surface");
    fields::addExact(*wrapper, "Reflectance", &MyClass::getReflectance, &MyClass::setReflectance);
    fields::addGone(*wrapper, "StencilCure", true, faultsAreGone);
    fields::addCompositorOptions<MyClass>(*wrapper);
}
