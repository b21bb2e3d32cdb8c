// SPDX-License-Identifier: MIT
#pragma once
#include "Keys.h"
#include "ShadowControls.h"

namespace gnomon::examples {

/// gnomonviewer's own keys.
const std::vector<Key<ShadowControls>>& shadowKeys();

} // namespace gnomon::examples
