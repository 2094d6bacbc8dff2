#include "ui/workspace/curved_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "io/curved.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

void showIn(Workspace& workspace, ViewId id, const Series& series, ViewKind kind) {
  ViewState& view = workspace.editView(id);
  view.series = keyOf(series);
  view.kind = kind;
  view.wanted.clear();
  view.flats.add(view.series, {});
}

// Takes window and colours from the source.
void addSeries(Workspace& workspace, const Series& series) {
  SeriesState state;
  if (const auto source = workspace.series.find(keyOf(sourceOf(series))); source != workspace.series.end())
    state.window = source->second.window, state.colours = source->second.colours;
  state.series = std::make_shared<const Series>(series);
  workspace.series.add(keyOf(series), state);
}

// Returns a view on screen with slices of a series, the one in focus first; null if there is none.
const ViewState* slicesOf(const Workspace& workspace, const SeriesKey& series) {
  for (const ViewId id : focusFirst(workspace, viewsOnScreen(workspace)))
    if (const ViewState& view = workspace.view(id); view.series == series && showsSlices(view.kind))
      return &view;
  return nullptr;
}

bool isUsed(const Workspace& workspace, const SeriesKey& series) {
  const auto isOfIt = [&](const auto& made) { return made.series == series; };
  return std::ranges::any_of(workspace.measurements, isOfIt) ||
         std::ranges::any_of(workspace.keyImages, isOfIt) ||
         std::ranges::any_of(workspace.segmentMaps, isOfIt);
}

Workspace withoutEarlier(Workspace workspace, const CurvedPair& pair) {
  for (const SeriesKey& key : unusedCurvesOf(workspace, keyOf(sourceOf(pair.straightened)))) {
    const std::string name = workspace.series.at(key).series->curved->name;
    if (name != pair.straightened.curved->name) continue;
    if (key == keyOf(pair.straightened) || key == keyOf(pair.stretched)) continue;
    workspace = without(std::move(workspace), key);
  }
  return workspace;
}

// Returns whether a series was reformatted along this curve in its present or an earlier form.
bool isAlong(const Series& series, const Measurement& curve) {
  return series.curved && keyOf(sourceOf(series)) == curve.series &&
         series.curved->name == nameText(curve).toStdString();
}

}  // namespace

std::vector<SeriesKey> unusedCurvesOf(const Workspace& workspace, const SeriesKey& source) {
  std::vector<SeriesKey> found;
  for (const auto& [key, state] : workspace.series)
    if (state.series->curved && keyOf(sourceOf(*state.series)) == source && !isUsed(workspace, key))
      found.push_back(key);
  return found;
}

glm::dvec3 usualTowards(const Workspace& workspace, const Measurement& curve) {
  for (const auto& [key, state] : workspace.series)
    if (isAlong(*state.series, curve) && state.series->curved->recipe.kind == CurvedKind::stretched)
      return state.series->curved->recipe.ruled;
  const auto state = workspace.series.find(curve.series);
  if (state == workspace.series.end()) return {0, 0, 1};
  const glm::dmat3& step = state->second.series->acquired.patientFromVoxelStep;
  return glm::normalize(glm::cross(step[0], step[1]));
}

Result<CurvedPair> curvedPair(const Workspace& workspace, const Measurement& curve, glm::dvec3 towards,
                              double halfWidth) {
  if (curve.shape.frame)
    return Error{"The curve lies on a picture as acquired: draw it in slices of a volume."};
  const auto state = workspace.series.find(curve.series);
  if (state == workspace.series.end() || state->second.missing)
    return Error{"The series of the curve was not found: open it first."};
  const Series& source = *state->second.series;
  const std::string name = nameText(curve).toStdString();
  std::vector<glm::dvec3> points = curve.shape.points;
  if (points.empty()) return Error{"A curve needs points at two different places: set another one."};
  const glm::dvec3 ruled = ruledDirection(points, towards);
  const bool isAcross = std::abs(ruled.z) > 0.5;
  if (isAcross && points.back().x < points.front().x) std::ranges::reverse(points);
  Result<Series> straightened =
      curvedSeries(source, {CurvedKind::straightened, points, {0, 0, 1}, halfWidth}, name);
  if (!straightened) return straightened.error();
  Result<Series> stretched = curvedSeries(source, {CurvedKind::stretched, points, ruled, halfWidth}, name);
  if (!stretched) return stretched.error();
  return CurvedPair{std::move(*straightened), std::move(*stretched)};
}

Workspace withCurvedPlanes(Workspace workspace, const CurvedPair& pair) {
  const Series source = sourceOf(pair.straightened);
  const ViewState* seen = slicesOf(workspace, keyOf(source));
  const ViewKind kind = seen ? seen->kind : acquiredKind(source.acquired);
  const FlatLook look = seen ? flatLookOf(*seen) : FlatLook();
  workspace = withoutEarlier(std::move(workspace), pair);
  workspace.layout = Layout::four;
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  addSeries(workspace, pair.straightened);
  addSeries(workspace, pair.stretched);
  showIn(workspace, views[0], source, kind);
  workspace.editView(views[0]).flats.editOrAdd(keyOf(source)) = look;
  showIn(workspace, views[1], pair.straightened, ViewKind::coronal);
  showIn(workspace, views[2], pair.stretched, ViewKind::coronal);
  showIn(workspace, views[3], pair.straightened, ViewKind::axial);
  workspace.focus = views[3];
  return workspace;
}

const Measurement* curveMeant(const Workspace& workspace) {
  const Measurement* selected = findMeasurement(workspace, workspace.selected);
  if (selected && selected->shape.kind == ShapeKind::openCurve) return selected;
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (!shown) return nullptr;
  const Measurement* last = nullptr;
  for (const Measurement& m : workspace.measurements)
    if (m.shape.kind == ShapeKind::openCurve && m.series == keyOf(sourceOf(*shown))) last = &m;
  return last;
}

}  // namespace volumen
