// SPDX-License-Identifier: MIT
#pragma once
#include <osg/RenderInfo>

namespace gnomon {

/// Is told, in draw, when the compositor begins its work for one stage, and when it has done it.
class DrawWatch : public osg::Referenced {
public:
    /// State sets are off the stack. OpenGL's state stays as it is.
    virtual void begin(osg::RenderInfo& renderInfo) = 0;
    /// The same. Only called after begin().
    virtual void end(osg::RenderInfo& renderInfo) = 0;

protected:
    ~DrawWatch() override = default;
};

} // namespace gnomon
