#include "ui/workspace/stack.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "io/study/frame_series.h"
#include "results/text/text.h"

namespace volumen {

namespace {

// Returns the slice numbers of a stack that follows the acquired slices, in the order of its positions. A
// series may number its slices in the direction opposite to that of the wheel.
std::vector<int> numbersOfSlices(const Series& series, int count, bool countsDown) {
  std::vector<int> numbers;
  for (int slice = 0; slice < count; ++slice) {
    const auto n = std::size_t(slice);
    if (!series.regular)
      numbers.push_back(slice + 1);
    else
      numbers.push_back(n < series.regular->copies.size() ? series.regular->copies[n] + 1 : 0);
  }
  if (countsDown) std::ranges::reverse(numbers);
  return numbers;
}

Stack slicesIn(const Workspace& workspace, ViewId view, const LoadedSeries& shown) {
  const ViewState& state = workspace.view(view);
  const Series& series = shown.series;
  const VoxelGeometry& geometry = shown.volume->geometry();
  const Crosshair crosshair = crosshairOf(workspace, view, shown);
  Stack stack = countedStack(tr("Slice"), stackPlace(geometry, state.kind, crosshair));
  const auto way = [&](int steps) { return scrolled(geometry, state.kind, crosshair, steps) - crosshair.at; };
  stack.toEnds = {way(-stack.place.count), way(stack.place.count)};
  SlicePlane plane = flatPlane(state, flatLookOf(state), geometry, crosshair, {1, 1});
  stack.seen = pictureSeen(series, geometry, plane);
  stack.isAcquired = onSlice(plane, geometry, 0).has_value();
  if (!stack.isAcquired) return stack;
  plane.slabMm = 0;
  stack.number = pictureSeen(series, geometry, plane).index.value_or(-1) + 1;
  if (series.regular) stack.numberCount = series.acquired.size.z;
  const glm::dvec3 down = stack.toEnds->second - stack.toEnds->first;
  stack.numbers =
      numbersOfSlices(series, stack.place.count, glm::dot(down, geometry.patientFromVoxelStep[2]) < 0);
  return stack;
}

}  // namespace

int Stack::numberOf(int position) const {
  if (numbers.empty()) return position + 1;
  const auto n = std::size_t(position);
  return n < numbers.size() ? numbers[n] : 0;
}

std::optional<int> Stack::placeOf(int wanted) const {
  if (numbers.empty()) return wanted - 1;
  const auto found = std::ranges::find(numbers, wanted);
  return found == numbers.end() ? std::nullopt : std::optional(int(found - numbers.begin()));
}

Stack countedStack(const QString& noun, StackPlace place) {
  return {.noun = noun, .place = place, .number = place.index + 1, .numberCount = place.count};
}

Stack framesIn(const Series& series, int index) {
  const int count = frameCount(series);
  index = std::clamp(index, 0, std::max(0, count - 1));
  Stack stack = countedStack(tr("Frame"), {index, count});
  stack.seen.index = index;
  stack.isAcquired = true;
  // Frames that form no volume have no known position until they are read.
  if (!series.notVolume.empty() || count != series.acquired.size.z) return stack;
  const glm::dvec3 step = series.acquired.patientFromVoxelStep[2];
  stack.toEnds = {-double(index) * step, double(count - 1 - index) * step};
  return stack;
}

Stack stackIn(const Workspace& workspace, ViewId view, const LoadedSeriesPtr& shown) {
  const ViewState& state = workspace.view(view);
  const Series* series = seriesIn(workspace, view);
  if (series && showsFrames(state.kind)) return framesIn(*series, flatLookOf(state).frame);
  return shown && showsSlices(state.kind) ? slicesIn(workspace, view, *shown) : Stack();
}

std::vector<int> keyImagePlaces(const Workspace& workspace, const Series& series, const Stack& stack) {
  std::vector<int> places;
  if (!stack.isAcquired) return places;
  for (const int index : keyImagesOf(workspace, series))
    if (const std::optional<int> place = stack.placeOf(index + 1)) places.push_back(*place);
  return places;
}

Workspace withPlace(Workspace workspace, ViewId view, const LoadedSeriesPtr& shown, int position) {
  const ViewState& state = workspace.view(view);
  const Series* series = seriesIn(workspace, view);
  if (series && showsFrames(state.kind)) {
    const StackPlace frame = framesIn(*series, position).place;
    if (frame.count > 0) workspace.editView(view).flats.editOrAdd(keyOf(*series)).frame = frame.index;
    return workspace;
  }
  if (!shown) return workspace;
  const VoxelGeometry& geometry = shown->volume->geometry();
  const Crosshair before = crosshairOf(workspace, view, *shown);
  Crosshair after = before;
  after.at =
      scrolled(geometry, state.kind, before, position - stackPlace(geometry, state.kind, before).index);
  return withCrosshair(std::move(workspace), view, frameOfReference(shown->series), before, after);
}

}  // namespace volumen
