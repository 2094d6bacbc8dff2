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

/// An attribute that may tell apart the pictures of one place.
struct Separator {
  /// What is said of a value: `before`, the value, `after`; or in a way of its own. A size is a number that
  /// scanners round.
  enum class Words { plain, size, imageType, direction, clock, seconds };
  /// When its values make volumes.
  enum class Trust {
    always,   ///< wherever they differ
    certain,  ///< where they differ at one place
    likely,   ///< where they differ at one place and are no more than there are pictures at one place
    needed    ///< only where pictures of one place are left that nothing above tells apart
  };
  /// How its values run along the slices of one acquisition.
  enum class Along {
    steady,  ///< they are all the same
    varies,  ///< they may differ from slice to slice
    counts   ///< the same, and the n-th value at each place belongs to the n-th volume (trigger times)
  };

  const char* keyword;  ///< DICOM's, of the attribute
  Trust trust;
  const char *before, *after;  ///< words and unit, English: "kernel ", " ms"
  Words words = Words::plain;
  Along along = Along::steady;
  std::string Series::*field = nullptr;  ///< where Series keeps the value; then it is no part of the label
};

/// All of them, those first that tell most surely.
std::span<const Separator> separators();

/// The values of one frame, as text, one a separator; empty where it does not say.
std::vector<std::string> readSeparators(const DataSet& data, const FrameScopes& at,
                                        const Dimensions& dimensions);

/// The number of the separator of this keyword, which is in the table.
std::size_t separatorAt(std::string_view keyword);

/// Sets the value of the separator of this keyword, which is in the table.
void setSeparator(Slice& slice, std::string_view keyword, const std::string& value);

/// What is said of value `n` of the different values of a separator: "kernel B70f", "phase 40 %".
std::string wordsOf(const Separator& separator, const std::vector<std::string>& values, std::size_t n);

/// The diffusion weight, s/mm^2: DICOM's, or the private one of Siemens, Philips or GE, which adds 10^9.
std::string readBValue(const DataSet& data, const FrameScopes& at);

/// The direction of the diffusion gradient in the patient (LPS) that a private attribute of Siemens or
/// Philips gives; empty where there is none.
std::vector<double> privateDirection(const DataSet& data);

/// The echo time in ms, as text.
std::string readEchoTime(const DataSet& data, const FrameScopes& at);

/// A number in the fewest digits.
std::string realText(double value);
/// That in an FD; empty where there is none.
std::string realText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// Functional groups that say what a frame shows.
inline constexpr std::uint32_t frameContentGroup = 0x00209111, mrEchoGroup = 0x00189114,
                               mrDiffusionGroup = 0x00189117;

}  // namespace volumen::dicom
