#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/dimensions.h"
#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"
#include "io/study/series.h"

namespace volumen::dicom {

/// An attribute that may separate pictures at one position.
struct Separator {
  /// How a value is worded: `before`, the value and `after`, or in a special way. A size is a number that
  /// scanners round.
  enum class Words { plain, size, imageType, direction, clock, seconds };
  /// Condition under which different values make separate volumes.
  enum class Trust {
    always,   ///< wherever they differ
    certain,  ///< if they differ at one position
    likely,   ///< if they differ at one position and are no more than the pictures there
    needed    ///< only if nothing above separates all pictures at one position
  };
  /// How values run along the slices of one acquisition.
  enum class Along {
    steady,  ///< all values are equal
    varies,  ///< may differ from slice to slice
    counts   ///< may differ, and the n-th value at each position belongs to the n-th volume (trigger times)
  };

  const char* keyword;  ///< DICOM keyword of the attribute
  Trust trust;
  const char *before, *after;  ///< words and unit, English: "kernel ", " ms"
  Words words = Words::plain;
  Along along = Along::steady;
  /// Member of Series that holds the value, which is then no part of the label.
  std::string Series::*field = nullptr;
};

/// Returns all separators, most reliable first.
std::span<const Separator> separators();

/// Returns the values of one frame as text, one for each separator; empty if not given.
std::vector<std::string> readSeparators(const DataSet& data, const FrameScopes& at,
                                        const Dimensions& dimensions);

/// Returns the index of the separator with this keyword, which must exist.
std::size_t separatorAt(std::string_view keyword);

/// Sets the value of the separator with this keyword, which must exist.
void setSeparator(Slice& slice, std::string_view keyword, const std::string& value);

/// Returns the words for value `n` among the distinct values of a separator: "kernel B70f", "phase 40 %".
std::string wordsOf(const Separator& separator, const std::vector<std::string>& values, std::size_t n);

/// Returns the echo time in ms, as text.
std::string readEchoTime(const DataSet& data, const FrameScopes& at);

/// Returns a number in its fewest digits.
std::string realText(double value);
/// Returns the number of a DS or IS in its fewest digits, or the text if it is none.
std::string numberText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);
/// Returns the number of an FD in its fewest digits; empty if there is none.
std::string realText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// Functional groups that describe what a frame shows.
inline constexpr std::uint32_t frameContentGroup = 0x00209111, mrEchoGroup = 0x00189114,
                               mrDiffusionGroup = 0x00189117;

}  // namespace volumen::dicom
