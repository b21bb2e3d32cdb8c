// SPDX-License-Identifier: MIT
#pragma once
#include "../StabilityScene.h"

namespace gnomon::examples {

// The sections of the stability table.
std::vector<StabilityScene> lightScenes();
std::vector<StabilityScene> receiverScenes();
std::vector<StabilityScene> numberScenes();
std::vector<StabilityScene> mapScenes();
std::vector<StabilityScene> blendingScenes();
std::vector<StabilityScene> meshScenes();

} // namespace gnomon::examples
