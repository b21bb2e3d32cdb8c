// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/TriangleDecoder.h>

#include <osg/Array>
#include <osg/Drawable>
#include <osg/Geometry>

namespace gnomon {

/// Reads a drawable's triangles, of integer vertex arrays and indirect primitives as well, which OpenSceneGraph's functors
/// leave out.
///
/// An attribute array on place 0 is read as OpenGL reads it: normalised if it says so. So is a vertex array that says so,
/// which holds under vertex attribute aliasing alone.
void readTriangles(const osg::Drawable& drawable, TriangleDecoder& into);

/// The vertices that OpenSceneGraph's functors take of a geometry; null if it has none.
const osg::Array* verticesOf(const osg::Geometry& geometry);

/// True if OpenSceneGraph can hand out the drawable's triangles: not those of particles, for one.
bool hasTriangles(const osg::Drawable& drawable);

/// The commands by which a primitive set is drawn indirectly; null for other sets.
const osg::BufferData* indirectCommands(const osg::PrimitiveSet& set);

/// True if a drawable has a shape that it hands out no triangles of: of a class with drawImplementation() alone, of
/// patches, or drawn by indirect commands that draw nothing as they stand in memory, for a program may write them. Text, particles, pixels and compute dispatches do not count: they cast nothing.
bool drawsItself(const osg::Drawable& drawable);

} // namespace gnomon
