#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Returns `text` without white space at both ends.
std::string_view trimmed(std::string_view text);

/// Returns the words of `text` between white space.
std::vector<std::string> words(std::string_view text);

std::string lowerCase(std::string_view text);
std::string upperCase(std::string_view text);

/// Returns the number if all of `text` is one, in any locale; NaN and infinities are numbers.
std::optional<double> toNumber(std::string_view text);
std::optional<std::int64_t> toInteger(std::string_view text);

/// Returns the numbers in `text`; empty if a word is not a number.
std::optional<std::vector<double>> toNumbers(std::string_view text);
/// Returns the sizes in `text`: whole numbers >= 1.
std::optional<std::vector<std::uint64_t>> toSizes(std::string_view text);

/// Returns the shortest text that parses to exactly `value` (-0 becomes 0).
std::string exactText(double value);

/// Removes the first line from `text` and returns it without its line end.
std::string_view takeLine(std::string_view& text);

/// Returns the file names of "PATTERN FIRST LAST STEP", where PATTERN holds one %d, %3d or %03d. The Error:
/// another conversion, a step of 0, or more than mostDataFiles names; it names `path`.
Result<std::vector<std::string>> expandPattern(const std::vector<std::string>& patternAndRange,
                                               const std::string& path);

/// Returns the text of a header field of unknown encoding: up to the first NUL, trimmed, with '?' for all but
/// ASCII.
std::string fieldText(std::string_view field);

}  // namespace volumen
