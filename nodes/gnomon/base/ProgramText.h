// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MatrixUniform.h>

#include <osg/Program>
#include <osg/StateAttribute>

#include <vector>

namespace gnomon {

/// What the GLSL text of a program says of where, and what, it draws.
///
/// A reader of text can be deceived: by functions, branches and uniforms.
struct ProgramPlaces {
    /// Vertices may go elsewhere than OpenGL's matrices take them: by instance, bone, displacement, or in another stage.
    bool movesVertices = false;
    /// The depth is not the one that the projection gives: a logarithm, or a gl_FragDepth of its own.
    bool setsDepth = false;
    /// Fragments may be discarded, or cut off by gl_ClipDistance.
    bool discards = false;
    /// The same by their place in the picture, as screen-door fades do. Through functions that compute from it, not through
    /// their arguments.
    bool discardsByPixel = false;
    /// Its text is not known: see mayApplyProgram(). It counts as one that does all of the above but the last.
    bool unseen = false;
    /// It reads OpenGL's or OpenSceneGraph's projection, or one that is named: where a light's stands in its place, it draws what
    /// the light sees.
    bool takesProjection = false;
    /// A geometry shader makes triangles, of points and lines, too.
    bool makesTriangles = false;

    /// True if what it moves is drawn into maps by itself. A screen door casts whole, as arrays stand.
    bool castsWhereItMoves() const { return movesVertices && takesProjection && !setsDepth && !discardsByPixel; }
};

/// Threads any number. What was found is kept, by the text.
/// @param matrices  uniforms that count as OpenGL's projection where the text declares and reads them as a mat4.
ProgramPlaces placesOf(const osg::Program& program, const std::vector<MatrixUniform>& matrices = {});
/// The same as placesOf().discards, and cheap for a program that does not.
bool mayDiscard(const osg::Program& program);
/// True if its text writes gl_ClipDistance, which a clip mode of each of its elements switches on.
bool writesClipDistance(const osg::Program& program);
/// True of an attribute that may draw by a program, and is no osg::Program: one of a type that OpenSceneGraph does not know, as
/// osgEarth's VirtualProgram, one of its shader composition's, or an ARB program that may move, discard or set a depth.
bool mayApplyProgram(const osg::StateAttribute& attribute);

} // namespace gnomon
