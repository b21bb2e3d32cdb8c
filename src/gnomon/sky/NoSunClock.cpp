// SPDX-License-Identifier: MIT
// SunClock in a build without libnova: none can be made, and the constructor says why.
#include <gnomon/OptionalParts.h>
#include <gnomon/SunClock.h>

#include <stdexcept>

namespace gnomon {
namespace {

[[noreturn]] void refuse() { throw std::runtime_error(whyMissing(OptionalPart::Sun)); }

} // namespace

std::optional<double> julianDay(const std::string&) { refuse(); }
std::string momentOf(double) { refuse(); }

SunClock::SunClock(double latitude, double longitude) : _latitude(latitude), _longitude(longitude) { refuse(); }

// Nobody has a clock to call these for.
SunPosition SunClock::at(double) const { refuse(); }
glm::dvec3 SunClock::towards(double) const { refuse(); }

} // namespace gnomon
