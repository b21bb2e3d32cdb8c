// SPDX-License-Identifier: MIT
#pragma once
#include "Staging.h"

#include <gnomon/ShadowSpec.h>

namespace gnomon::examples {

/// A scene under one of Gnomon's techniques. In Look::VISIBILITY composite=blend darkens to black.
class GnomonStaging : public Staging {
public:
    /// @throws std::invalid_argument, one sentence, if the specification does not suit the scene.
    GnomonStaging(ShadowSpec spec, const ChartScene& scene, Look look);
    void setLight(const osg::Vec4d& light) override;
    void setCasting(bool casts) override;
    std::vector<std::string> diagnose() const override;
    std::vector<ShadowDecision> decisions() const override;

private:
    osg::ref_ptr<ShadowCasterGroup> _group;
    std::vector<osg::ref_ptr<ShadowTechnique>> _techniques;
};

} // namespace gnomon::examples
