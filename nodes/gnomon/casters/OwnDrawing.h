// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casting.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Referenced>
#include <osg/StateSet>
#include <osg/ref_ptr>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon {

/// A caster whose shape, or whose clear parts, only its own code, program or state knows, at one place in the graph. It
/// never changes. drawsItself() and CasterDrawable::ownDrawn tell which drawables are such.
///
/// Limits
/// - It counts as changed by its place, bounds, arrays, state sets and their uniforms. What moves otherwise is DYNAMIC.
struct OwnDrawing : public osg::Referenced {
    /// Of the drawable at the end of a path, which begins at the group.
    OwnDrawing(const osg::NodePath& path, const osg::Drawable& drawable, const osg::Matrixd& groupFromLocal,
               const Casting& casting);

    /// Changes with all that is known to change the drawing.
    static std::uint64_t fingerprintOf(const osg::NodePath& path, const osg::Drawable& drawable,
                                       const osg::Matrixd& groupFromLocal, const Casting& casting);

    const std::uint64_t fingerprint;
    const osg::ref_ptr<const osg::Drawable> drawable;
    const osg::Matrixd groupFromLocal;
    const std::vector<osg::ref_ptr<osg::StateSet>> states; ///< Along the path and above it, the outermost first.
    const std::string name;                                ///< Of the drawable, or the nearest named node above it.
    osg::BoundingBoxd bounds;                              ///< Group frame. Invalid if nobody knows them.
    const Casting casting;                                 ///< What its states leave of it.
    const bool hasPiece;                                   ///< Its triangles are those of a CasterDrawable, too.
    bool byProgram = false;                                ///< A program draws it, which may depend on the view.
    bool mayChange = false;                                ///< It may be another in each frame.

    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< Held, so that no other can stand at their addresses.

protected:
    ~OwnDrawing() override = default;
};

} // namespace gnomon
