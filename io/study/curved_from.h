#pragma once

#include <memory>
#include <string>

#include "viewer/slice/curved_volume.h"

namespace volumen {

struct Series;

/// What a series that is laid out along a curve was made of (io/curved.h).
struct CurvedFrom {
  std::shared_ptr<const Series> source;  ///< never null, itself along no curve
  CurvedRecipe recipe;
  std::string name;  ///< of the curve: "Curve 1"

  /// Whether they are of equal series, too.
  bool operator==(const CurvedFrom& other) const;
};

}  // namespace volumen
