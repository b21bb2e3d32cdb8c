// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>

#include <osg/Image>
#include <osg/StateSet>
#include <osg/Texture>
#include <osg/observer_ptr>

#include <vector>

namespace gnomon {

/// The sets that a drawing is under, the outermost first.
using DrawnStates = std::vector<osg::ref_ptr<osg::StateSet>>;

/// Mixes in all that sets give a drawing: modes, uniforms, defines, and attributes with what may be set in them.
///
/// Cost  some hundred instructions a set, and one a byte of its shaders' texts.
void mixStates(const DrawnStates& states, Fingerprint& into);
/// Adds the objects that mixStates() identifies by address, but for images that are let go once drawn.
void holdStates(const DrawnStates& states, std::vector<osg::ref_ptr<const osg::Referenced>>& sources);

/// What a texture is sampled by: how, and its images, but for those that are let go once drawn. See ReleasedImages.
void mixTexture(const osg::Texture& texture, Fingerprint& into);
/// True of a texture that OpenGL draws without: it has no image, as where the file was not found, and nobody draws into it.
bool holdsNothing(const osg::Texture& texture);
/// True if nothing here tells when a texture's contents change: it is rendered to, or a callback of its own fills it.
bool changesUnseen(const osg::Texture& texture);
/// True if a drawing may be another in each frame by its states: a clock that a program reads, a texture or buffer whose
/// contents change unseen, or an attribute of a class that is not OpenSceneGraph's.
bool changesUnseen(const DrawnStates& states);

/// The images of textures that let them go once drawn. They are not held, so their addresses tell nothing.
class ReleasedImages {
public:
    explicit ReleasedImages(const DrawnStates& states);
    /// True if a texture has got another image since.
    bool haveOther() const;

private:
    struct Released {
        osg::ref_ptr<const osg::Texture> texture;
        osg::observer_ptr<const osg::Image> image;
        unsigned count; ///< of changes.
    };
    std::vector<Released> _all;
};

} // namespace gnomon
