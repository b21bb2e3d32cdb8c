// SPDX-License-Identifier: MIT
#include <gnomon/OptionalParts.h>
#include <gnomon_missing.h>

namespace gnomon {

std::string whyMissing(OptionalPart part) {
    switch (part) {
    case OptionalPart::Traced:
        return missing::traced;
    case OptionalPart::Terrain:
        return missing::terrain;
    case OptionalPart::Sun:
        return missing::sun;
    }
    return {};
}

} // namespace gnomon
