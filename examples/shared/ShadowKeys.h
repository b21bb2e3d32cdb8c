// SPDX-License-Identifier: MIT
#pragma once
#include "Keys.h"
#include "ShadowControls.h"

namespace gnomon::examples {

/// The keys of Gnomon's own, of gnomonviewer and gnomonrun.
const std::vector<Key<ShadowControls>>& shadowKeys();

} // namespace gnomon::examples
