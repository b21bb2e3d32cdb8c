// SPDX-License-Identifier: MIT
#pragma once
#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>

/// Versions of the kit's part of scene files.
///
/// In binary files each object of the kit begins with a mark and a version. OSG's own header cannot tell it, because the
/// programs that write files do not know the kit. Text files name their properties and need no version. A property that
/// is added belongs into a new version, here 4, and `fileVersion` becomes 4:
///
///     {
///         UPDATE_TO_VERSION_SCOPED(4)
///         ADD_BOOL_SERIALIZER(Tint, fresh->getTint());
///     }
namespace gnomon::fields {

/// OSG's word for the library that a version belongs to.
constexpr const char* fileDomain = "gnomon";
/// The version that is written, and the only one that is read: older ones are of no release.
constexpr int fileVersion = 3;

/// A place in a file to go back to.
class Bookmark {
public:
    explicit Bookmark(osgDB::InputStream& in);
    void goBack() const;

private:
    std::istream& _file;
    const std::istream::pos_type _place;
};

} // namespace gnomon::fields

/// Registers the wrapper of gnomon::NAME. The body of a function that adds properties to `wrapper` follows. One wrapper a
/// file.
/// @param OSG_BASES  names of OSG's classes that it inherits, the first one first.
/// @param KIT_BASES  the same of the kit's classes.
#define GNOMON_WRAPPER(NAME, CREATE, OSG_BASES, KIT_BASES)                                                             \
    static void addProperties(osgDB::ObjectWrapper* wrapper);                                                          \
    REGISTER_CUSTOM_OBJECT_WRAPPER(gnomon, gnomon_##NAME, CREATE, gnomon::NAME,                                        \
                                   OSG_BASES " gnomon::FileVersion " KIT_BASES " gnomon::" #NAME) {                    \
        static_cast<void>(domain);                                                                                     \
        addProperties(wrapper);                                                                                        \
    }                                                                                                                  \
    static void addProperties(osgDB::ObjectWrapper* wrapper)
