#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Without the white space at both ends.
std::string_view trimmed(std::string_view text);

/// The words between white space.
std::vector<std::string> words(std::string_view text);

std::string lowerCase(std::string_view text);
std::string upperCase(std::string_view text);

/// The number that the whole of `text` is, in any locale; NaN and infinities count as numbers.
std::optional<double> toNumber(std::string_view text);
std::optional<std::int64_t> toInteger(std::string_view text);

/// The numbers that `text` consists of; nothing where a word is no number.
std::optional<std::vector<double>> toNumbers(std::string_view text);
/// The same for sizes: whole numbers >= 1.
std::optional<std::vector<std::uint64_t>> toSizes(std::string_view text);

/// The shortest text that reads back as exactly `value` (-0 as 0).
std::string exactText(double value);

/// Takes the first line of `text`, without its line end; `text` then starts behind it.
std::string_view takeLine(std::string_view& text);

/// The file names that "PATTERN FIRST LAST STEP" stands for, where PATTERN holds one %d, %3d or %03d. Any
/// other conversion, a step of 0 and more than mostDataFiles names are refused; `path` is for the sentence.
Result<std::vector<std::string>> expandPattern(const std::vector<std::string>& patternAndRange,
                                               const std::string& path);

/// Text of a header's field, of unknown encoding: up to the first NUL, trimmed, what is not ASCII replaced by
/// '?'.
std::string fieldText(std::string_view field);

}  // namespace volumen
