// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/FrameDepthCopy.h>

#include <OpenThreads/Mutex>
#include <osg/StateSet>

#include <atomic>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// What a ShadowMapTechnique's marks share: they belong to it, so that they are released with its other OpenGL objects.
class MapPrograms : public osg::Referenced {
public:
    MapPrograms();

    const osg::ref_ptr<osg::StateSet> casterProgram, casterByLampProgram, cutoutProgram, blocksProgram, coneProgram;
    FrameDepthCopy seen;
    std::atomic<unsigned> passes{0}; ///< maps drawn so far.

    /// The programs for these defines, see map.frag and map_view.frag; made at their first use.
    osg::ref_ptr<const osg::StateSet> program(const std::string& defines);
    osg::ref_ptr<const osg::StateSet> viewProgram(const std::string& defines);
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~MapPrograms() override = default;

private:
    std::vector<osg::ref_ptr<osg::StateSet>> all();

    OpenThreads::Mutex _mutex;
    using Programs = std::map<std::string, osg::ref_ptr<osg::StateSet>>;
    osg::ref_ptr<const osg::StateSet> of(Programs& programs, const std::string& defines, const std::string& shader);

    Programs _programs, _viewPrograms;
};

} // namespace gnomon
