// SPDX-License-Identifier: MIT
#pragma once
#include "JsonFields.h"

#include <metrics/ShadowMetrics.h>

#include <string>

namespace gnomon::examples {

/// The numbers as a person reads them, a line a metric.
std::string reportText(const metrics::ShadowMetrics& metrics);

/// Which there are, in words; "none".
std::string catastropheText(const metrics::Catastrophes& catastrophes);

/// The same in full. Shares are 0 to 1; what does not exist is null; units are in the names.
nlohmann::ordered_json reportJson(const metrics::ShadowMetrics& metrics);

/// The fields of both, see FieldWriter.
void fields(FieldWriter& way, const metrics::ShadowMetrics& metrics);
void fields(FieldReader& way, metrics::ShadowMetrics& metrics);

} // namespace gnomon::examples
