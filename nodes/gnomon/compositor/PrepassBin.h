// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/ShadowJob.h>

#include <osgUtil/RenderBin>

namespace gnomon {

/// The first bin of a stage whose drawables' programs look up shadows: draws what these need.
class PrepassBin : public osgUtil::RenderBin {
public:
    PrepassBin() = default;
    PrepassBin(const PrepassBin& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osgUtil::RenderBin(other, copyOp) {}
    osg::Object* cloneType() const override { return new PrepassBin; }
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new PrepassBin(*this, copyOp); }
    const char* libraryName() const override { return "gnomon"; }
    const char* className() const override { return "PrepassBin"; }

    /// Lets the programs of a stage find the first of the jobs that are for them, until the stage is reset.
    static void show(const std::vector<ShadowJob>& jobs, osgUtil::RenderStage& stage);

    void drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) override;

protected:
    ~PrepassBin() override;

private:
    ShadowJob _job;
};

} // namespace gnomon
