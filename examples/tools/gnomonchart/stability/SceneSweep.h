// SPDX-License-Identifier: MIT
#pragma once
#include "../measure/FlickerRun.h"
#include "StabilityPlan.h"

#include <memory>

namespace gnomon::examples {

/// Measures contenders in one scene over its sweep. The truth of a value is made when it is first needed, and kept.
///
/// Cost    a truth: 34 rays a pixel and two small frames; a cell: a context, and two frames. A film: 17 truths, made once
///         for all contenders, and a context and 34 frames for each.
class SceneSweep {
    struct Value;

public:
    SceneSweep(const StabilityPlan& plan, const StabilityScene& scene) : _plan(plan), _scene(scene) {
        _values.resize(scene.values.size());
    }

    /// One contender from value to value.
    class Run {
    public:
        Run(SceneSweep& sweep, const Contender& contender) : _sweep(sweep), _contender(contender) {}
        /// Never throws: what goes wrong is in the cell.
        StabilityCell cell(std::size_t place);
        /// While the camera moves. @throws what the contender throws.
        StabilityFlicker flicker(std::size_t place);

    private:
        void measure(std::size_t place, StabilityCell& cell);
        int receivers(const Value& value) const;
        void addStrip(const metrics::FlickerChange& worst, StabilityFlicker& flicker) const;
        void addPicture(std::size_t place, const metrics::Picture& visibility, StabilityCell& cell);

        SceneSweep& _sweep;
        const Contender& _contender;
        bool _left = false;
    };

    /// The best settings of a peer at the middle value.
    Settings bestSettings(const Peer& peer);

private:
    /// What is true at one value. Positions are about the scene's centre.
    struct Value {
        explicit Value(const StabilityCase& made);

        Yardstick yardstick;
        metrics::TruthMaps maps;
        int flatObjects, terrainObjects; ///< ids of receivers are from 1 to this.
        std::optional<Film> film;        ///< made when it is first needed.
    };

    Value& value(std::size_t place);
    const Film& film(std::size_t place);

    const StabilityPlan& _plan;
    const StabilityScene& _scene;
    std::vector<std::unique_ptr<Value>> _values;
};

} // namespace gnomon::examples
