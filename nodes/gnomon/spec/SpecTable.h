// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowSpec.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A key of the specification string. --help, refusals and the pages take all that they say of it from here.
struct SpecKey {
    std::string name;
    std::string meaning;
    std::string unit = {};               ///< of the range; empty: none.
    std::vector<std::string> words = {}; ///< that are allowed, beside the range.
    std::string range = {};              ///< "0 to 20"; empty: only words are allowed.
    std::string byDefault = {};
    std::function<bool(ShadowSpec&, const std::string& value)> take = {}; ///< false if the value is not allowed.

    /// "auto, 1 to 4"; "0 to 20, degrees".
    std::string allowed() const;
};

/// A technique that the specification string can name.
struct SpecTechnique {
    std::string name;
    std::string meaning = {};
    std::string receiver = {};             ///< name of the node that receives where none is named; empty: everything.
    std::vector<SpecKey> keys = {};        ///< its own.
    std::optional<OptionalPart> part = {}; ///< that it needs; empty: it is in every build.

    /// See whyMissing().
    std::string whyUnavailable() const { return part ? whyMissing(*part) : ""; }
};

/// The table of techniques, of those that this build lacks, too.
const std::vector<SpecTechnique>& specTechniques();
/// The technique of that name.
/// @throws std::invalid_argument if there is none, or this build lacks a library for it.
const SpecTechnique& requireTechnique(const std::string& name);

/// A technique's own keys, then those that every technique has.
std::vector<SpecKey> keysOf(const SpecTechnique& technique);

/// "a, b, c".
std::string listed(const std::vector<std::string>& words);

} // namespace gnomon
