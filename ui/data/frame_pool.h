#pragma once

#include <map>
#include <vector>

#include "results/series/loaded_frame.h"

namespace volumen {

/// Keeps frames in memory. Beyond a budget of bytes it evicts the least recently used frames that nobody else
/// holds: evicting a frame that a view shows would free nothing.
class FramePool {
 public:
  explicit FramePool(std::size_t budget) : budget_(budget) {}

  /// Returns null if the frame is not in memory. Counts as use.
  LoadedFramePtr find(const FrameKey& key);
  /// Returns the indices of the frames that it holds of a series in this presentation, ascending.
  std::vector<int> heldOf(const SeriesKey& series, const std::string& presentation) const;
  bool contains(const FrameKey& key) const { return held_.contains(key); }
  /// Keeps a frame, whatever its size.
  void put(LoadedFramePtr frame);
  void setBudget(std::size_t bytes);
  /// Drops frames that nobody else holds until at most so many bytes are left.
  void dropBeyond(std::size_t most);

  std::size_t bytes() const { return bytes_; }
  std::size_t budget() const { return budget_; }

 private:
  struct Held {
    LoadedFramePtr frame;
    std::size_t lastUse;
  };

  std::map<FrameKey, Held> held_;
  std::size_t budget_, bytes_ = 0, uses_ = 0;
};

}  // namespace volumen
