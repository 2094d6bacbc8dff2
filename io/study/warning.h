#pragma once

#include <string>
#include <utility>
#include <vector>

namespace volumen {

/// The subject of a warning.
enum class WarningKind {
  other,          ///< the picture shows what the files hold
  missingSlices,  ///< slices between others are missing and interpolated
  unevenSlices,   ///< slices at uneven distances are resampled
  sheared,        ///< slices are not stacked along their normal (gantry tilt)
  offLine,        ///< a slice is drawn beside its true position
  noDirections,   ///< left and right, front and back are guessed
  notCalibrated,  ///< lengths and directions are unknown
  unread,         ///< files of the series could not be read
  notSeparated,   ///< several pictures share a position and no attribute separates them
  curved,         ///< resampled along a curve: lengths off the curve are not true
  reduced         ///< drawn from a copy of fewer voxels, as there was too little memory
};

/// A warning about a series: one sentence with mm and file names.
struct Warning {
  std::string sentence;
  WarningKind kind = WarningKind::other;

  Warning(std::string text, WarningKind about = WarningKind::other)
      : sentence(std::move(text)), kind(about) {}
  bool operator==(const Warning&) const = default;
};

/// Returns the kind's name for scripts: "missingSlices".
const char* kindName(WarningKind kind);

/// Returns the warnings that change the picture, all but WarningKind::other, in their order.
std::vector<Warning> changingPicture(const std::vector<Warning>& warnings);

/// Returns each kind of warning once in a few words, for the picture: "Slices missing".
std::vector<std::string> shortWarnings(const std::vector<Warning>& warnings);

/// Appends sentences as warnings of kind `other`.
void addSentences(std::vector<Warning>& warnings, const std::vector<std::string>& sentences);

}  // namespace volumen
