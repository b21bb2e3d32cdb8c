// SPDX-License-Identifier: MIT
#pragma once
#include "Keys.h"
#include "SceneSetup.h"

#include <algorithm>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What a user changes while looking: technique, composite, and where the light is.
class ShadowControls {
public:
    ShadowControls(const ViewOptions& options, SceneSetup& setup);

    /// Next of shadowTechniques(); that of the command line as it was given there.
    void nextTechnique();
    void toggleComposite();
    /// Degrees, clockwise from above, about the scene's centre.
    void turnLight(double degrees);
    /// Degrees; stops overhead and underfoot.
    void raiseLight(double degrees);
    /// Lets time go on over --sun's place; nights of up to a day are passed over. Seconds.
    void runSun(double seconds);
    /// Next of the views of shadow maps.
    void nextView();
    /// Whether describe() says what each technique did in the last frame. Looks anew for causes that take long to find.
    void toggleReports();

    /// How things stand, a line each, and why shadows are missing.
    std::vector<std::string> describe() const;

private:
    using Specs = std::vector<ShadowSpec>;

    void cast();
    void applySwitches();
    /// Whether one of this class is drawn now.
    template <class Technique>
    bool draws() const {
        return std::any_of(_setup.techniques.begin(), _setup.techniques.end(),
                           [](const auto& each) { return dynamic_cast<const Technique*>(each.get()) != nullptr; });
    }
    std::string describeShadow() const;
    std::string describeLight() const;

    SceneSetup& _setup;
    std::optional<SunMoment> _sun; ///< now.
    std::vector<Specs> _choices;
    std::size_t _chosen = 0;
    std::string _refusal; ///< why the chosen technique does not suit the scene, or the last key does nothing.
    SceneLights::Direction _moved{0.0, 0.0};
    ShadowMapTechnique::View _view = ShadowMapTechnique::NOTHING;
    bool _showsVolumes = false, _showsReports = false;
};

/// The keys of Gnomon's own, of gnomonviewer and gnomonrun.
const std::vector<Key<ShadowControls>>& shadowKeys();

} // namespace gnomon::examples
