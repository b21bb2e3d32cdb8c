// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace gnomon::examples {

/// Where and by what results are made: date, versions, renderer, processor, cores, memory. Needs a HeadlessContext,
/// which it makes.
std::vector<std::pair<std::string, std::string>> machineFacts();

/// Processes that run or wait for a core, averaged over a minute, as the system tells; "unknown" where it does not.
std::string machineLoad();

} // namespace gnomon::examples
