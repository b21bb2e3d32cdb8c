// SPDX-License-Identifier: MIT
#pragma once
#include <support/TwoReceivers.h>

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace test {

/// A case under the light's first or second place.
using ReceiverParam = std::tuple<ReceiverCase, int>;

inline std::string caseName(const testing::TestParamInfo<ReceiverParam>& info) {
    return std::get<0>(info.param).name + (std::get<1>(info.param) == 0 ? "" : "FromElsewhere");
}

/// Every pixel of frames 1 to 3 is the one that the rays choose, with the receivers named (both ways of the compositor)
/// and not; diagnose() says no more and no less than the case expects.
void expectExact(const ReceiverParam& param);

} // namespace test
