#pragma once

#include <optional>
#include <string>
#include <vector>

namespace volumen {

/// The name that was probably meant by a mistyped word: the one with the fewest letters to change, add or
/// leave out, where capitals do not count; none where more than a third of the letters differ.
std::optional<std::string> similarName(const std::string& word, const std::vector<std::string>& names);

}  // namespace volumen
