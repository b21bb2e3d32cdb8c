// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Drawable>

#include <cstdint>

namespace gnomon {

/// How a picture follows vertices that are edited in place, without Array::dirty().
enum class Follows {
    Counts, ///< not at all: OpenGL has a copy in buffers, which only counted changes renew.
    List,   ///< once its display list is released, as dirtyGLObjects() does.
    Each    ///< in each frame: there is no copy, or it is DYNAMIC.
};
Follows followsOf(const osg::Drawable& drawable);

/// Stands for what a drawable is drawn from: vertices, normals and indices.
/// @param all  arrays count, colours and coordinates as well.
///
/// Cost  an instruction a byte of a geometry. Of what is no geometry, all that its PrimitiveFunctor does.
std::uint64_t contentsOf(const osg::Drawable& drawable, bool all);

/// Notes whether a drawable's display list has been released since its contents were read.
class ListWatch {
public:
    /// @param contexts  of OpenGL that there are.
    /// @return true if what the list will show, or shows now, has not been read.
    ///
    /// Limits  what has never been drawn has no list to be released: its first visits alone count.
    bool mayBeStale(const osg::Drawable& drawable, unsigned contexts);

private:
    bool _hadList = false;
    unsigned char _visits = 0; ///< without a list.
};

} // namespace gnomon
