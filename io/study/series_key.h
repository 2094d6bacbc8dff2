#pragma once

#include <compare>
#include <string>

#include "io/study/series.h"

namespace volumen {

/// Identifies a series: where it was found, and its id there.
struct SeriesKey {
  std::string path, id;
  auto operator<=>(const SeriesKey&) const = default;
  bool empty() const { return path.empty() && id.empty(); }
};

inline SeriesKey keyOf(const Series& series) { return {series.path, series.id}; }

}  // namespace volumen
