#pragma once

#include <QString>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// A window that the user named, for series of one modality whose numbers on screen have one unit.
struct OwnWindow {
  std::string modality, unit;  ///< "CT", "HU"
  QString name;
  Window window;  ///< in the numbers on screen, its width above 0
  bool operator==(const OwnWindow&) const = default;
};
using OwnWindows = std::vector<OwnWindow>;

/// Whether it is for this series, as its numbers are shown now.
bool isFor(const OwnWindow& own, const Series& series);

/// As text for settings, and back: what is none of them is left out.
QString ownWindowsText(const OwnWindows& windows);
OwnWindows ownWindowsIn(const QString& text);

}  // namespace volumen
