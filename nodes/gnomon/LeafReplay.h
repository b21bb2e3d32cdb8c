// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/StageLeaves.h>

#include <osg/Program>
#include <osg/RenderInfo>
#include <osg/State>

#include <map>
#include <vector>

namespace gnomon {

/// Draws render leaves of the frame once more, with what the compositor wants of stencil, depth and lights laid over
/// each leaf's own state.
///
/// Whatever a leaf's state sets, PROTECTED or not, what is laid over holds: it goes to OpenGL after the leaf's state
/// and before its draw. At the end osg::State is told what it can no longer take for granted.
class LeafReplay {
public:
    /// What is laid over each leaf.
    struct Overlay {
        GLenum stencilFunction = GL_ALWAYS; ///< compares (reference & test) with (stencil & test).
        unsigned reference = 0, test = 0;
        unsigned write = 0;      ///< bits that become those of `reference` where drawn.
        bool equalDepth = false; ///< only where the leaf's depth is the one that stands; depth is not written.
        bool color = true;
        float unlit = 0.5f;  ///< a leaf that should lose a light and cannot is drawn in its own colour times this.
        float factor = 1.0f; ///< below 1: what stands is multiplied by it, and the leaf's own colour does not matter.
    };

    LeafReplay(osg::RenderInfo& renderInfo, const Overlay& overlay);
    ~LeafReplay(); ///< puts lights and state back; the stack of state sets is as it was.
    LeafReplay(const LeafReplay&) = delete;
    LeafReplay& operator=(const LeafReplay&) = delete;

    /// @param dark  bit i: draw it without the diffuse and specular of OpenGL light i.
    void draw(const StageLeaf& entry, unsigned dark = 0);

    /// Leaves drawn so far that could not lose a light: lighting is off, or a program reads no OpenGL light.
    const std::vector<const osgUtil::RenderLeaf*>& notRelit() const { return _notRelit; }

private:
    void enter(osgUtil::RenderBin* bin);
    void layOver();
    void darken(unsigned lights);
    bool canBeRelit();
    void drawFaded(const osgUtil::RenderLeaf& leaf);

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    const Overlay _overlay;
    const unsigned _stackSize;
    unsigned _dark = 0; ///< lights that are dark in OpenGL now.
    std::map<const osg::Program::PerContextProgram*, bool> _readsLights;
    std::vector<const osgUtil::RenderLeaf*> _notRelit;
    osgUtil::RenderBin* _bin = nullptr;
    osgUtil::StateGraph* _previous = nullptr; ///< whose state sets are on the stack.
};

} // namespace gnomon
