// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowDecision.h>

#include <string>
#include <vector>

namespace gnomon::examples {

/// A line of C++ that adds a candidate's technique to a group.
std::string cppFor(const ShadowCandidate& candidate);

/// For each light a table of what could draw its shadow: of each technique the best, the choice first.
std::string recommendation(const std::vector<ShadowDecision>& decisions);

} // namespace gnomon::examples
