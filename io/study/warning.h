#pragma once

#include <string>
#include <utility>
#include <vector>

namespace volumen {

/// What a warning is about.
enum class WarningKind {
  other,          ///< the picture shows what the files hold
  missingSlices,  ///< slices between others are not there: interpolated
  unevenSlices,   ///< slices at uneven distances: interpolated
  sheared,        ///< the slices are not stacked along their normal (gantry tilt)
  offLine,        ///< a slice is drawn beside its place
  noDirections,   ///< left and right, front and back are a guess
  notCalibrated,  ///< lengths and directions are not known
  unread,         ///< files of it could not be read
  notSeparated,   ///< several pictures at one place, and nothing in the files tells which belong together
  curved          ///< resampled along a curve: lengths off it are not true
};

/// What is to be known of a series: one sentence, mm and file names.
struct Warning {
  std::string sentence;
  WarningKind kind = WarningKind::other;

  Warning(std::string text, WarningKind about = WarningKind::other)
      : sentence(std::move(text)), kind(about) {}
  bool operator==(const Warning&) const = default;
};

/// The kind's name for scripts: "missingSlices".
const char* kindName(WarningKind kind);

/// The warnings that change what is seen: all but WarningKind::other, in their order.
std::vector<Warning> changingPicture(const std::vector<Warning>& warnings);

/// Each warning's kind in a few words, for the picture: "Slices missing". None twice.
std::vector<std::string> shortWarnings(const std::vector<Warning>& warnings);

/// Adds sentences of kind `other`.
void addSentences(std::vector<Warning>& warnings, const std::vector<std::string>& sentences);

}  // namespace volumen
