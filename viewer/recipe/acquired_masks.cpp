#include "viewer/recipe/acquired_masks.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "viewer/recipe/step_names.h"
#include "viewer/segment/numbers.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

template <std::size_t N>
bool isOneOf(const std::array<std::string_view, N>& kinds, const std::string& kind) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

constexpr std::array<std::string_view, 3> ofValues{"range", "otsu", "lesion"};
constexpr std::array<std::string_view, 6> ofMasks{"copy", "add", "subtract", "intersect", "invert", "empty"};
constexpr std::array<std::string_view, 5> ofParts{"largest", "islands", "keep", "remove", "connected"};

// Returns whether a step decides each voxel by its value and the other segments there. For a lesion, the
// region limits the voxels.
bool isOfVoxels(const Step& step) {
  const auto margin = step.fields.find("marginMm");
  const bool hasMargin = margin != step.fields.end() && std::get<double>(margin->second) > 0;
  return isOneOf(ofValues, step.kind) || (isOneOf(ofMasks, step.kind) && !hasMargin);
}

}  // namespace

bool AcquiredMasks::doneOnSlices(const Step& step, const CancelToken& cancel) {
  if (!isOfVoxels(step) || !runStep(step, *slices_.volume, masks_, cancel)) return false;
  const std::vector<std::string> needed = neededBy(step);
  const bool isOfSuch = isOneOf(ofMasks, step.kind) &&
                        std::ranges::any_of(needed, [&](const auto& name) { return isInterpolated(name); });
  if (isOfSuch)
    interpolated_.insert(step.segment);
  else
    interpolated_.erase(step.segment);
  return true;
}

// Returns the remaining voxels that are in by their own value, and the components attached to them on the
// slices.
BitMask AcquiredMasks::narrowed(const Step& step, const BitMask& before, const BitMask& after,
                                const CancelToken& cancel) const {
  const BitMask& own = masks_.at(step.segment);
  const BitMask left = intersected(onAcquired(after, slices_), own);
  if (!isOneOf(ofParts, step.kind)) return left;
  const BitMask notLost = subtracted(own, onAcquired(subtracted(before, after), slices_));
  const Parts parts(notLost, Neighbours::faces, cancel);
  std::vector<bool> chosen(parts.count());
  for (const glm::ivec3& voxel : voxelsOf(left)) chosen[parts.of(voxel)] = true;
  return parts.mask(chosen);
}

void AcquiredMasks::add(const Step& step, const NamedMasks& before, const NamedMasks& after,
                        const CancelToken& cancel) {
  if (doneOnSlices(step, cancel)) return;
  const auto was = before.find(step.segment);
  const bool narrows = onlyNarrows(step) && was != before.end() && masks_.contains(step.segment);
  for (const std::string& name : changedBy(step)) {
    if (!narrows || !isOneOf(ofParts, step.kind)) interpolated_.insert(name);
    masks_.insert_or_assign(name, narrows ? narrowed(step, was->second, after.at(name), cancel)
                                          : onAcquired(after.at(name), slices_));
  }
}

void AcquiredMasks::keep(const NamedMasks& kept) {
  std::erase_if(masks_, [&](const auto& named) { return !kept.contains(named.first); });
}

}  // namespace volumen
