// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Casting.h>
#include <gnomon/casters/Hiding.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class CasterExtraction;
struct CasterBody;

/// A drawable that casts, at one place in the graph, in one revision. A piece never changes.
///
/// A drawable with several parents is one piece for each path to it.
struct CasterDrawable : public osg::Referenced {
    std::uint64_t fingerprint = 0;              ///< Changes with all that CasterExtraction reads of it.
    std::uint64_t geometry = 0;                 ///< The same, wherever it is.
    osg::ref_ptr<const osg::Drawable> drawable; ///< The drawable itself.
    osg::Matrixd groupFromLocal;                ///< Transform from the drawable's frame to the group's.
    Hiding hiding = Hiding::Both;               ///< What it hides in the view.
    Casting casting;                            ///< What its states leave of it.
    osg::BoundingBoxd bounds;                   ///< Bounds of its triangles, group frame. Invalid without triangles.
    std::size_t triangles = 0;                  ///< Number of its triangles.
    unsigned invalidTriangles = 0;              ///< Triangles left out; see CasterExtraction::getInvalidTriangles().
    std::string invalidNode;                    ///< See CasterExtraction::getInvalidNode().
    bool cutOut = false;                        ///< It has triangles that are clear in part.
    bool ownDrawn = false;                      ///< The same, and only its own drawing tells what is clear.
    osg::ref_ptr<const TextureAlpha> alphas;    ///< Of the texture that its casting looked at; may be null.
    std::string cutoutNode;                     ///< See CasterExtraction::getCutoutNode().
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< See CasterExtraction::getSources().
    bool ofLevels = false;                                    ///< It is under an LOD: it may go and come back.
    osg::ref_ptr<const CasterExtraction> kept;   ///< Its triangles, if it is under an LOD and no body. Else null.
    mutable osg::ref_ptr<const CasterBody> body; ///< CasterBodies keeps it here, under its owner's lock.

protected:
    ~CasterDrawable() override = default;
};

} // namespace gnomon
