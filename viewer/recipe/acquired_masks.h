#pragma once

#include <set>
#include <string>

#include "viewer/recipe/recipe.h"

namespace volumen {

/// Masks on the slices as acquired, kept in step with the masks on the grid resampled from them. Steps that
/// decide per voxel run on the slices themselves. Results of other steps are taken over by nearest neighbour,
/// except that steps removing whole components remove them here too.
class AcquiredMasks {
 public:
  explicit AcquiredMasks(const AcquiredSlices& slices) : slices_(slices) {}

  /// Applies a step that turned `before` into `after` on the grid.
  void add(const Step& step, const NamedMasks& before, const NamedMasks& after, const CancelToken& cancel);
  /// Drops all masks but these.
  void keep(const NamedMasks& kept);

  const NamedMasks& masks() const { return masks_; }
  /// Returns whether a mask contains voxels that were interpolated from the grid.
  bool isInterpolated(const std::string& name) const { return interpolated_.contains(name); }

 private:
  bool doneOnSlices(const Step& step, const CancelToken& cancel);
  BitMask narrowed(const Step& step, const BitMask& before, const BitMask& after,
                   const CancelToken& cancel) const;

  const AcquiredSlices& slices_;
  NamedMasks masks_;
  std::set<std::string> interpolated_;
};

}  // namespace volumen
