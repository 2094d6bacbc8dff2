#pragma once

#include <QString>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// A window that the user named, for series of one modality and displayed unit.
struct OwnWindow {
  std::string modality, unit;  ///< "CT", "HU"
  QString name;
  Window window;  ///< in displayed units; its width is above 0
  bool operator==(const OwnWindow&) const = default;
};
using OwnWindows = std::vector<OwnWindow>;

/// Returns whether it applies to a series in its present displayed unit.
bool isFor(const OwnWindow& own, const Series& series);

/// Returns windows as text for the settings. ownWindowsIn() reads it back and leaves out what is invalid.
QString ownWindowsText(const OwnWindows& windows);
OwnWindows ownWindowsIn(const QString& text);

}  // namespace volumen
