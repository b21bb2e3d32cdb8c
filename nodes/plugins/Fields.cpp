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

bool writeOptions(osgDB::OutputStream& out, const CompositorOptions& options) {
    out << options.reservedStencilBits << options.skipsUntouched << std::endl;
    return true;
}

CompositorOptions readOptions(osgDB::InputStream& in) {
    CompositorOptions options;
    in >> options.reservedStencilBits >> options.skipsUntouched;
    return options;
}

} // namespace gnomon::fields
