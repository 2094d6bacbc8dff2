#include "ui/workspace/curved_planes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

// By the window and the colours of its source.
void addSeries(Workspace& workspace, const Series& series) {
  SeriesState state;
  if (const auto source = workspace.series.find(keyOf(sourceOf(series))); source != workspace.series.end())
    state.window = source->second.window, state.colours = source->second.colours;
  state.series = std::make_shared<const Series>(series);
  workspace.series.add(keyOf(series), state);
}

// The view that shows slices of a series, the one in focus first; none on screen: none.
const ViewState* slicesOf(const Workspace& workspace, const SeriesKey& series) {
  std::vector<ViewId> views = viewsOnScreen(workspace);
  std::ranges::stable_partition(views, [&](ViewId id) { return id == workspace.focus; });
  for (const ViewId id : views)
    if (const ViewState& view = workspace.view(id); view.series == series && showsSlices(view.kind))
      return &view;
  return nullptr;
}

bool isUsed(const Workspace& workspace, const SeriesKey& series) {
  const auto isOfIt = [&](const auto& made) { return made.series == series; };
  return std::ranges::any_of(workspace.measurements, isOfIt) ||
         std::ranges::any_of(workspace.segmentMaps, isOfIt);
}

Workspace withoutEarlier(Workspace workspace, const CurvedPair& pair) {
  const SharedMap<SeriesKey, SeriesState> all = workspace.series;
  for (const auto& [key, state] : all) {
    const Series& series = *state.series;
    if (!series.curved || series.curved->name != pair.straightened.curved->name) continue;
    if (keyOf(sourceOf(series)) != keyOf(sourceOf(pair.straightened))) continue;
    if (key == keyOf(pair.straightened) || key == keyOf(pair.stretched) || isUsed(workspace, key)) continue;
    workspace = without(std::move(workspace), key);
  }
  return workspace;
}

}  // namespace

Result<CurvedPair> curvedPair(const Workspace& workspace, const Measurement& curve, glm::dvec3 towards,
                              double halfWidth) {
  if (curve.shape.frame)
    return Error{"The curve lies on a picture as acquired: draw it in slices of a volume."};
  const auto state = workspace.series.find(curve.series);
  if (state == workspace.series.end() || state->second.missing)
    return Error{"The series of the curve was not found: open it first."};
  const Series& source = *state->second.series;
  const std::string name = nameText(curve).toStdString();
  CurvedRecipe recipe{CurvedKind::straightened, curve.shape.points, {0, 0, 1}, halfWidth};
  Result<Series> straightened = curvedSeries(source, recipe, name);
  if (!straightened) return straightened.error();
  recipe.kind = CurvedKind::stretched;
  recipe.ruled = ruledDirection(recipe.points, towards);
  const bool isAcross = std::abs(recipe.ruled.z) > 0.5;
  if (isAcross && recipe.points.back().x < recipe.points.front().x) std::ranges::reverse(recipe.points);
  Result<Series> stretched = curvedSeries(source, recipe, name);
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
