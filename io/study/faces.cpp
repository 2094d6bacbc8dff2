#include "io/study/faces.h"

#include <QString>
#include <algorithm>

namespace volumen {

bool mayShowFace(const std::string& modality, const std::string& words) {
  static const char* const ofHead[] = {"HEAD",  "BRAIN", "SKULL", "FACE",     "FACIAL", "ORBIT",
                                       "SINUS", "NECK",  "KOPF",  "SCHAEDEL", "HIRN",   "CRAN",
                                       "CEREB", "CEREV", "NEURO", "WHOLE"};
  if (modality != "CT" && modality != "MR" && modality != "PT") return false;
  const QString upper = QString::fromStdString(words).toUpper();
  return std::ranges::any_of(ofHead, [&](const char* word) { return upper.contains(QLatin1String(word)); });
}

std::optional<bool> showsFaceIn3d(const SeriesIdentity& series) {
  const std::string words = series.bodyPart + " " + series.studyDescription + " " + series.description;
  if (mayShowFace(series.modality, words)) return true;
  if (series.bodyPart.empty()) return {};
  return false;
}

std::optional<bool> showFaceIn3d(const SeriesIdentity& one, const SeriesIdentity& other) {
  const auto ofOne = showsFaceIn3d(one), ofOther = showsFaceIn3d(other);
  if (ofOne == true || ofOther == true) return true;
  return ofOne ? ofOther : ofOne;
}

}  // namespace volumen
