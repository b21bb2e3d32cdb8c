// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/volume/VolumeView.h>

#include <glm/vec2.hpp>
#include <osg/StateSet>

namespace gnomon {

/// Marks of one light in one view: what is in a volume.
class VolumeMark : public MarkJob {
public:
    SeenVolumes seen;
    osg::ref_ptr<const osg::StateSet> program;
    glm::dvec2 pushedBack{0.0}; ///< see ViewFrame.
    bool showsVolumes = false;

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool counts() const override { return true; }
    bool hasView() const override { return showsVolumes; }
    void drawView(osg::RenderInfo& renderInfo, ScreenPass& pass, int before) const override;

protected:
    ~VolumeMark() override = default;

private:
    void count(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned counters, const MeshInView& mesh,
               const VolumeRound::Share& share) const;
    using Ranges = std::vector<VolumeGeometry::Range>;
    void drawCaps(osg::RenderInfo& renderInfo, const VolumeGeometry& caps, const Ranges& ranges) const;
    void uncountBacks(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned counters, const MeshInView& mesh,
                      const VolumeRound::Share& share) const;
};

} // namespace gnomon
