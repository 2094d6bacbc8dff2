#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <vector>

#include "io/study/series_key.h"
#include "results/series/loaded_series.h"
#include "viewer/segment/mask.h"

namespace volumen {

class StoredVoxels;

/// A volume of a series: with a mask applied, or complete if that is empty.
struct PoolKey {
  SeriesKey series;
  Mask mask;
  bool operator==(const PoolKey&) const = default;
};

/// The series in memory, and what was computed of their volumes. Both can be made again. Beyond the budget,
/// what is off screen is dropped: first computed data, then series, each by the longest time since the last
/// need. Thread-safe.
class SeriesPool {
 public:
  /// Returns how many bytes this process can still take.
  using Available = std::function<std::uint64_t()>;

  /// `budget`: bytes to keep, those on screen included.
  explicit SeriesPool(std::size_t budget = partOfMemory(25), Available available = availableNow);

  /// Returns null if it is not in memory. Counts as need.
  LoadedSeriesPtr find(const PoolKey& key);
  /// Does the same as find(), but does not count as need.
  LoadedSeriesPtr peek(const PoolKey& key) const;
  void put(const PoolKey& key, LoadedSeriesPtr series);
  /// Counts a volume as long as others hold it.
  void watch(const VolumePtr& volume);
  /// Returns what was computed of a volume, for all that draw it. It is made where there is none, and kept as
  /// long as somebody else holds the volume. Counts as need.
  std::shared_ptr<StoredVoxels> voxelsOf(const VolumePtr& volume);

  /// Sets what is on screen from now on. Lets go of what is beyond the budget.
  void setOnScreen(std::vector<PoolKey> keys);
  /// Counts the bytes that a holder keeps elsewhere; 0: nothing any more.
  void count(const void* holder, std::size_t bytes);
  void setBudget(std::size_t bytes);
  std::size_t budget() const;

  /// Memory within the budget that others hold and can do without. Both functions are called with the pool
  /// locked, by any thread.
  struct Guest {
    std::function<std::size_t()> bytes;
    std::function<void(std::size_t most)> dropBeyond;  ///< drops what is not in use beyond `most` bytes
  };
  /// Counts a guest until leave(). It gives way last.
  void host(const void* holder, Guest guest);
  void leave(const void* holder);
  /// Drops what is beyond the budget, as after a guest has grown.
  void fit();
  /// Drops data until `bytes` more fit. Returns false if they do not fit even then.
  bool makeRoomFor(std::size_t bytes);
  void forget(const SeriesKey& key);
  void clear();
  /// Returns true if some volumes are held only by what was computed of them, or may soon be.
  bool hasIdle() const;
  /// Forgets what was computed of volumes that nobody else holds.
  void dropUnheld();

  /// Returns true if a volume of `bytes` has room beside what is on screen.
  bool hasRoomFor(std::size_t bytes) const;
  /// Returns the bytes of the series held and of what was computed.
  std::size_t bytes() const;
  /// Returns all bytes in the budget: those of bytes(), those counted elsewhere, and volumes dropped here
  /// that others still hold.
  std::size_t counted() const;
  /// Returns `percent` of the memory that this process could take.
  static std::size_t partOfMemory(int percent);

 private:
  // A volume and the data computed from it.
  struct Held {
    std::weak_ptr<const Volume> volume;
    std::size_t volumeBytes = 0;
    PoolKey key{};             // of `series`
    LoadedSeriesPtr series{};  // null: only others hold the volume
    std::shared_ptr<StoredVoxels> computed{};

    std::size_t bytes() const;
    bool isInUse() const;  // whether others hold `computed`
  };
  using Garbage = std::vector<std::shared_ptr<const void>>;  // destroyed after the lock is released

  static std::uint64_t availableNow();
  std::list<Held>::const_iterator withKey(const PoolKey& key) const;
  Held& firstOf(const VolumePtr& volume, const std::function<bool(const Held&)>& fits);
  bool isOnScreen(const Held& held) const;
  std::size_t inMemory() const;
  std::size_t letGoBeyond(std::size_t most, Garbage& garbage);
  std::size_t letGuestsDropBeyond(std::size_t most, std::size_t left);
  void letGoIf(const std::function<bool(const Held&)>& isGone);

  const Available available_;
  mutable std::mutex mutex_;  // guards what follows
  std::list<Held> held_;      // the last needed first
  std::vector<PoolKey> onScreen_;
  std::map<const void*, std::size_t> elsewhere_;  // by holder
  std::map<const void*, Guest> guests_;           // likewise
  std::size_t budget_;
};

}  // namespace volumen
