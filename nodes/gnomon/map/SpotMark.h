// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/map/MapLookupPass.h>

namespace gnomon {

/// Marks of one spot in one view: what of all that is seen is not in its cone.
class SpotMark : public MarkJob {
public:
    osg::ref_ptr<MapPrograms> resources;
    glm::dmat4 clipFromScene{1.0}; ///< as drawn.
    glm::dmat4 coneFromScene{1.0}; ///< see gnomon::coneFromScene().

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool relightsOnly() const override { return true; }

protected:
    ~SpotMark() override = default;
};

} // namespace gnomon
