// SPDX-License-Identifier: MIT
#include "Fields.h"

#include <gnomon/ShadowTechnique.h>

#include <osg/Notify>

#include <iomanip>

namespace gnomon::fields {

bool writeSelection(osgDB::OutputStream& out, const Selection& selection) {
    out << out.BEGIN_BRACKET << std::endl;
    out << out.PROPERTY("Mask") << std::hex << std::showbase << selection.mask << std::dec << std::noshowbase;
    out << std::endl;
    out << out.PROPERTY("Node") << selection.node.valid();
    if (selection.node) {
        out << out.BEGIN_BRACKET << std::endl;
        out.writeObject(selection.node.get());
        out << out.END_BRACKET;
    }
    out << std::endl << out.END_BRACKET << std::endl;
    return true;
}

Selection readSelection(osgDB::InputStream& in) {
    Selection selection;
    bool hasNode = false;
    in >> in.BEGIN_BRACKET;
    in >> in.PROPERTY("Mask") >> std::hex >> selection.mask >> std::dec;
    in >> in.PROPERTY("Node") >> hasNode;
    if (hasNode) {
        in >> in.BEGIN_BRACKET;
        selection.node = in.readObjectOfType<osg::Node>();
        in >> in.END_BRACKET;
    }
    in >> in.END_BRACKET;
    return selection;
}

bool writeOthers(osgDB::OutputStream& out, const Selection& selection) {
    return writeList(out, selection.others, [&](const auto& node) { out.writeObject(node.get()); });
}

Selection withOthers(osgDB::InputStream& in, Selection selection) {
    selection.others = readList(in, [&] { return in.readObjectOfType<osg::Node>(); });
    return selection;
}

void UnavailableWarning::objectRead(osgDB::InputStream&, osg::Object& object) {
    const auto& technique = dynamic_cast<const ShadowTechnique&>(object);
    const std::string why = technique.whyUnavailable();
    if (!why.empty()) OSG_WARN << "gnomon: " << technique.describe() << " is in the file. " << why << std::endl;
}

namespace {

class RetiredSwitch : public osgDB::BaseSerializer {
public:
    explicit RetiredSwitch(const char* name) : BaseSerializer(READ_WRITE_PROPERTY), _name(name) {}
    const std::string& getName() const override { return _name; }

    bool read(osgDB::InputStream& in, osg::Object&) override {
        bool on = true;
        if (in.isBinary() || in.matchString(_name)) in >> on;
        return true;
    }
    bool write(osgDB::OutputStream& out, const osg::Object&) override {
        if (out.isBinary()) out << true;
        return true;
    }

private:
    const std::string _name;
};

} // namespace

void addRetiredSwitch(osgDB::ObjectWrapper& wrapper, const char* name) {
    wrapper.addSerializer(new RetiredSwitch(name), osgDB::BaseSerializer::RW_UNDEFINED);
}

bool writeOptions(osgDB::OutputStream& out, const CompositorOptions& options) {
    out << options.reservedStencilBits << options.skipsUntouched << std::endl;
    return true;
}

CompositorOptions readOptions(osgDB::InputStream& in) {
    CompositorOptions options;
    in >> options.reservedStencilBits >> options.skipsUntouched;
    return options;
}

bool GoneNumber::read(osgDB::InputStream& in, osg::Object& object) {
    if (!in.isBinary() && !in.matchString(_name)) return true;
    if (readExact<double>(in) != 0.0)
        OSG_NOTICE << "gnomon: " << _name << " of '" << object.getName() << "' has no effect any more: " << _now << "."
                   << std::endl;
    return true;
}

bool GoneNumber::write(osgDB::OutputStream& out, const osg::Object&) {
    if (out.isBinary()) out << 0.0;
    return true;
}

} // namespace gnomon::fields
