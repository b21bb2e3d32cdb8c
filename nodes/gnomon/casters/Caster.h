// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casting.h>
#include <gnomon/casters/DrawableContents.h>
#include <gnomon/casters/DrawnState.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Referenced>
#include <osg/StateSet>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class CasterExtraction;
class CasterMesh;

/// A drawable that casts, at one place in the graph, in one revision. It never changes.
///
/// A drawable with several parents is one caster for each path to it.
struct Caster : public osg::Referenced {
    std::uint64_t fingerprint = 0;              ///< Changes with all that CasterExtraction reads of it.
    std::uint64_t geometry = 0;                 ///< The same, wherever it is.
    std::uint64_t contents = 0;                 ///< See contentsOf(); 0 if counts tell.
    mutable ListWatch list;                     ///< The visitor that makes casters keeps it here, under a lock.
    osg::ref_ptr<const osg::Drawable> drawable; ///< The drawable itself.
    osg::Matrixd groupFromLocal;                ///< Transform from the drawable's frame to the group's.
    Hiding hiding = Hiding::Both;               ///< What it hides in the view.
    Casting casting;                            ///< What its states leave of it.
    osg::BoundingBoxd bounds;                   ///< Bounds of its triangles, group frame. Invalid without triangles.
    std::size_t triangles = 0;                  ///< Number of its triangles.
    unsigned invalidTriangles = 0;              ///< Triangles left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;                    ///< See CasterExtraction::getInvalidNode().
    bool cutOut = false;                        ///< It has triangles that are clear in part, or that a program moves.
    bool selfDrawn = false;                     ///< The same, and only its own drawing tells what is where.
    osg::ref_ptr<const TextureAlpha> alphas;    ///< Of the texture that its casting looked at; may be null.
    std::string cutoutNode;                     ///< See CasterExtraction::getCutoutNode(); of Casting::byPixel, too.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< See CasterExtraction::getSources().
    bool ofLevels = false;                                    ///< It is under an LOD: it may go and come back.
    osg::ref_ptr<const CasterExtraction> kept;   ///< Its triangles, if it is under an LOD and no body. Else null.
    mutable osg::ref_ptr<const CasterMesh> body; ///< KnownCasters keeps it here, under its owner's lock.

protected:
    ~Caster() override = default;
};

/// Drawables with fewer triangles are joined: to draw them apart would cost more than to make them again.
constexpr std::size_t fewestOfABody = 256;
/// True if it can be a body, which moves as a whole: large enough, of all its triangles, and not flattened by its transform.
bool isBody(const Caster& piece);

/// Casters, one for each drawable and path.
using CasterList = std::vector<osg::ref_ptr<const Caster>>;

/// A caster whose shape, place or clear parts only its own code, program or state knows, at one place in the graph. It
/// never changes. drawsItself() and Caster::selfDrawn tell which drawables are such.
///
/// Limits
/// - It counts as changed by its place, bounds, arrays and all that its state sets give, uniforms by their values. Where
///   contents cannot be told it is drawn again in each frame; see changesUnseen(). What moves otherwise is DYNAMIC.
struct SelfDrawing : public osg::Referenced {
    /// Of the drawable at the end of a path, which begins at the group.
    SelfDrawing(const osg::NodePath& path, const osg::Drawable& drawable, const osg::Matrixd& groupFromLocal,
                const Casting& casting);

    /// The sets along a path and above it, by first parents.
    static DrawnStates statesAlong(const osg::NodePath& path);
    /// Of all that is known to change the drawing, but for the edition.
    /// @param placed  of its geometry, see CasterFingerprint.
    /// @param states  of its states, see mixStates().
    static std::uint64_t fingerprintOf(const osg::Drawable& drawable, std::uint64_t placed, std::uint64_t states);

    std::uint64_t fingerprint = 0;
    unsigned edition = 0;   ///< how often its list was released, or an image that is not held replaced.
    mutable ListWatch list; ///< as Caster has it.
    const osg::ref_ptr<const osg::Drawable> drawable;
    const osg::Matrixd groupFromLocal;
    const DrawnStates states;    ///< Along the path and above it.
    const ReleasedImages images; ///< Of these.
    const std::string name;      ///< Of the drawable, or the nearest named node above it.
    osg::BoundingBoxd bounds;    ///< Group frame. Invalid if nobody knows them.
    const Casting casting;       ///< What its states leave of it.
    const bool hasPiece;         ///< Its triangles are those of a Caster, too.
    bool byProgram = false;      ///< A program draws it, which may depend on the view.
    bool mayChange = false;      ///< It may be another in each frame.

    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< Held, so that no other can stand at their addresses.

protected:
    ~SelfDrawing() override = default;
};

} // namespace gnomon
