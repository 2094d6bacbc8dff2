#pragma once

#include <optional>
#include <string>
#include <vector>

namespace volumen {

/// Returns the name that a mistyped word probably meant: the one with the smallest edit distance, ignoring
/// case. Empty if more than a third of the letters differ.
std::optional<std::string> similarName(const std::string& word, const std::vector<std::string>& names);

}  // namespace volumen
