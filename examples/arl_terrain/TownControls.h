// SPDX-License-Identifier: MIT
#pragma once
#include "Keys.h"
#include "TownScene.h"

namespace gnomon::examples {

/// What a user changes while looking at the town: technique, composite and time of day.
class TownControls {
public:
    explicit TownControls(TownScene& town);

    /// none, box, hull, and on from the first; that of the command line as it was given there.
    void nextTechnique();
    void toggleComposite();
    /// Hours; stops while the sun is up.
    void passTime(double hours);
    /// How things stand, a line each, the keys, and why shadows are missing.
    std::vector<std::string> describe() const;

private:
    TownScene& _town;
    std::vector<ShadowSpec> _choices;
    std::size_t _chosen = 0;
};

const std::vector<Key<TownControls>>& townKeys();

} // namespace gnomon::examples
