#pragma once

#include <cstdint>
#include <list>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/data/series_key.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Which volume of a series: as it is, or without what a mask takes away.
struct PoolKey {
  SeriesKey series;
  Mask mask;
  bool operator==(const PoolKey&) const = default;
};

/// The series in memory. Beyond a budget those that were used longest ago go first; never what is on screen.
class SeriesPool {
 public:
  /// `budget`: bytes of voxels to keep, those on screen included.
  explicit SeriesPool(std::size_t budget = partOfMemory(25));

  /// Null where it is not in memory. Counts as use.
  LoadedSeriesPtr find(const PoolKey& key);
  void put(const PoolKey& key, LoadedSeriesPtr series);
  /// What is on screen from now on, and how many bytes of voxels are held elsewhere for it; drops what is
  /// beyond the budget.
  void setOnScreen(std::vector<PoolKey> keys, std::size_t elsewhere = 0);
  void setBudget(std::size_t bytes);
  void forget(const SeriesKey& key);
  /// Whether a volume of so many bytes has room beside what is on screen.
  bool hasRoomFor(std::size_t bytes) const;
  void clear() { held_.clear(); }

  /// Of the voxels held.
  std::size_t bytes() const;
  /// So many percent of the machine's memory.
  static std::size_t partOfMemory(int percent);

 private:
  struct Held {
    PoolKey key;
    LoadedSeriesPtr series;
  };
  void dropBeyondBudget();

  std::list<Held> held_;  // the last used first
  std::vector<PoolKey> onScreen_;
  std::size_t budget_, elsewhere_ = 0;
};

}  // namespace volumen
