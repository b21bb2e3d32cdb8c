// SPDX-License-Identifier: MIT
#include "FileVersion.h"

#include <osgDB/OutputStream>
#include <osgDB/Serializer>

#include <algorithm>
#include <iterator>

namespace {

using gnomon::fields::fileDomain;
using gnomon::fields::fileVersion;

constexpr char mark[] = {'g', 'n', 'm', 'n'}; // files without it have switches, enumerators or numbers here

/// The stream below, which OSG shows to none but classes that inherit.
struct Below : osgDB::InputStream {
    static std::istream& of(osgDB::InputStream& in) { return *(in.*&Below::_in)->getStream(); }
};

bool isMarked(osgDB::InputStream& in) {
    char found[std::size(mark)] = {};
    const gnomon::fields::Bookmark here(in);
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
        if (version < fileVersion)
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

namespace gnomon::fields {

Bookmark::Bookmark(osgDB::InputStream& in) : _file(Below::of(in)), _place(_file.tellg()) {}

void Bookmark::goBack() const {
    _file.clear(); // the end may have been met
    _file.seekg(_place);
}

} // namespace gnomon::fields

// No class of its own: what every class of the kit has before its properties.
REGISTER_CUSTOM_OBJECT_WRAPPER2(gnomon, gnomon_FileVersion, nullptr, osg::Object, "gnomon::FileVersion", "") {
    static_cast<void>(domain);
    wrapper->addSerializer(new VersionSerializer, osgDB::BaseSerializer::RW_UNDEFINED);
}
