#pragma once

#include <memory>
#include <string>

#include "viewer/slice/curved_volume.h"

namespace volumen {

struct Series;

/// The origin of a series that was resampled along a curve (io/curved.h).
struct CurvedFrom {
  std::shared_ptr<const Series> source;  ///< never null, never curved itself
  CurvedRecipe recipe;
  std::string name;  ///< name of the curve: "Curve 1"

  /// Returns whether both have equal source series (not just the same pointer), recipes and names.
  bool operator==(const CurvedFrom& other) const;
};

}  // namespace volumen
