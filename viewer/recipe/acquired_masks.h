#pragma once

#include <set>
#include <string>

#include "viewer/recipe/recipe.h"

namespace volumen {

/// Masks on the slices as acquired, kept while steps are done on the grid that is drawn of them. Steps that
/// decide voxel by voxel are done on the slices themselves. What other steps leave is that of the nearest
/// voxel; those that leave out whole parts leave them out here.
class AcquiredMasks {
 public:
  explicit AcquiredMasks(const AcquiredSlices& slices) : slices_(slices) {}

  /// Does a step that made `after` of `before` on the grid.
  void add(const Step& step, const NamedMasks& before, const NamedMasks& after, const CancelToken& cancel);
  /// Lets go of all but these.
  void keep(const NamedMasks& kept);

  const NamedMasks& masks() const { return masks_; }
  /// Whether a mask has more than the slices themselves say.
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
