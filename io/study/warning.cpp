#include "io/study/warning.h"

#include <algorithm>
#include <iterator>

namespace volumen {

const char* kindName(WarningKind kind) {
  static constexpr const char* names[] = {"other",        "missingSlices", "unevenSlices",  "sheared",
                                          "offLine",      "noDirections",  "notCalibrated", "unread",
                                          "notSeparated", "curved",        "reduced"};
  return names[int(kind)];
}

std::vector<Warning> changingPicture(const std::vector<Warning>& warnings) {
  std::vector<Warning> changing;
  std::ranges::copy_if(warnings, std::back_inserter(changing),
                       [](const Warning& w) { return w.kind != WarningKind::other; });
  return changing;
}

std::vector<std::string> shortWarnings(const std::vector<Warning>& warnings) {
  static constexpr const char* words[] = {"",
                                          "Slices missing",
                                          "Slices interpolated",
                                          "Gantry tilt",
                                          "Slice displaced",
                                          "Directions not known",
                                          "Not calibrated",
                                          "Slices not read",
                                          "Slices may not belong together",
                                          "Curved: measure along or across it",
                                          "Reduced copy: too little memory"};
  std::vector<std::string> texts;
  for (const Warning& w : changingPicture(warnings))
    if (std::ranges::find(texts, words[int(w.kind)]) == texts.end()) texts.push_back(words[int(w.kind)]);
  return texts;
}

void addSentences(std::vector<Warning>& warnings, const std::vector<std::string>& sentences) {
  warnings.insert(warnings.end(), sentences.begin(), sentences.end());
}

}  // namespace volumen
