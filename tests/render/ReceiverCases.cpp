// SPDX-License-Identifier: MIT
#include "ReceiverCases.h"

namespace test {

void expectExact(const ReceiverParam& param) {
    const auto& [given, angle] = param;
    const ReceiverTruth truth(given, angle);
    EXPECT_GT(truth.shadowOnLeft(), 100) << "the case shows no shadow to judge";
    EXPECT_GT(truth.shadowOnRight(), 100) << "the case shows no shadow to judge";
    for (const Receiving receiving : {Receiving::Named, Receiving::NamedAmongOthers, Receiving::Unnamed}) {
        SCOPED_TRACE(nameOf(receiving));
        const ReceiverVerdict found = truth.judge(receiving);
        EXPECT_EQ(found.wrongLit, 0);
        EXPECT_EQ(found.wrongAny, 0);
        const bool unnamed = receiving == Receiving::Unnamed;
        EXPECT_EQ(found.causes.size(), given.causes) << (found.causes.empty() ? "" : found.causes.front());
        if (unnamed && !given.exactUnnamed) continue;
        EXPECT_EQ(found.wrongInside, 0);
        EXPECT_EQ(found.wrongAtEdge, 0);
        EXPECT_LE(found.flipped, found.edges / 20); // where outlines run through pixels' centres
    }
}

} // namespace test
