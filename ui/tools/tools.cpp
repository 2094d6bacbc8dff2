#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/stack.h"

namespace volumen {

std::unique_ptr<SceneDrag> beginRotate(const ScenePress& press);
std::unique_ptr<SceneDrag> beginCurve(const ScenePress& press);
std::unique_ptr<SceneDrag> beginScissors(const ScenePress& press);
std::unique_ptr<SceneDrag> beginSceneZoom(const ScenePress& press);
std::unique_ptr<Drag> beginWindow(const SlicePress& press);
std::unique_ptr<Drag> beginSliceZoom(const SlicePress& press);
std::unique_ptr<Drag> beginScroll(const SlicePress& press);
std::unique_ptr<Drag> beginRegionWindow(const SlicePress& press);
std::unique_ptr<Drag> beginPart(const SlicePress& press);
std::unique_ptr<SceneDrag> beginScenePart(const ScenePress& press);
std::unique_ptr<Drag> beginPaint(const SlicePress& press);
std::unique_ptr<Drag> beginSmartBrush(const SlicePress& press);
void paintBrushAt(QPainter& painter, const SlicePress& pointer);
bool resizeBrush(Session& session, int key);
std::unique_ptr<Drag> beginOutline(const SlicePress& press);
std::unique_ptr<Drag> beginSegmentScissors(const SlicePress& press);
std::unique_ptr<SceneDrag> beginSceneSegmentScissors(const ScenePress& press);
std::unique_ptr<Drag> beginLesion(const SlicePress& press);
std::unique_ptr<Drag> beginLevelTrace(const SlicePress& press);
void paintLevelTrace(QPainter& painter, const SlicePress& pointer);
std::unique_ptr<Drag> beginMagnifier(const SlicePress& press);
std::vector<Tool> measuringTools();

const std::vector<Tool>& tools() {
  static const std::vector<Tool> table = [] {
    std::vector<Tool> all{
        {"rotate", tr("Rotate"), Qt::ArrowCursor, nullptr, beginRotate, Qt::Key_T},
        {"curve", tr("Adjust curve (W/L)"), Qt::SizeAllCursor, nullptr, beginCurve, Qt::Key_W},
        {.name = "scissors",
         .text = tr("Scissors"),
         .cursor = Qt::CrossCursor,
         .inScene = beginScissors,
         .key = Qt::Key_X,
         .otherWords = tr("cut crop sculpt remove")},
        {.name = "window",
         .text = tr("Window"),
         .cursor = Qt::ArrowCursor,
         .inSlices = beginWindow,
         .key = Qt::Key_W,
         .otherWords = tr("brightness contrast level WL")},
        {"scroll", tr("Scroll"), Qt::SizeVerCursor, beginScroll},
        {"pan", tr("Pan"), Qt::SizeAllCursor, beginSlicePan, beginScenePan},
        {"zoom", tr("Zoom"), Qt::ArrowCursor, beginSliceZoom, beginSceneZoom},
        {"crosshair", tr("Crosshair"), Qt::CrossCursor, beginCrosshair},
        {.name = "magnifier",
         .text = tr("Magnifier"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginMagnifier,
         .looking = true,
         .otherWords = tr("loupe lens zoom")},
        {.name = "regionWindow",
         .text = tr("Window from region"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginRegionWindow,
         .box = true},
        {.name = "part",
         .text = tr("Connected part"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginPart,
         .inScene = beginScenePart,
         .clicks = true},
        {.name = "paint",
         .text = tr("Paint"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginPaint,
         .clicks = true,
         .paintAt = paintBrushAt,
         .takesKey = resizeBrush,
         .otherWords = tr("brush draw segment contour")},
        {.name = "outline",
         .text = tr("Outline"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginOutline,
         .stays = true,
         .box = true},
        {.name = "segmentScissors",
         .text = tr("Cut segment"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginSegmentScissors,
         .inScene = beginSceneSegmentScissors,
         .stays = true,
         .box = true},
        {.name = "lesion",
         .text = tr("Lesion in a sphere"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginLesion,
         .clicks = true,
         .otherWords = tr("tumour tumor metastasis MTV TLG")},
        {.name = "levelTrace",
         .text = tr("Level trace"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginLevelTrace,
         .clicks = true,
         .paintAt = paintLevelTrace},
        {.name = "smartBrush",
         .text = tr("Smart brush"),
         .cursor = Qt::CrossCursor,
         .inSlices = beginSmartBrush,
         .clicks = true,
         .paintAt = paintBrushAt,
         .takesKey = resizeBrush},
    };
    std::ranges::move(measuringTools(), std::back_inserter(all));
    return all;
  }();
  return table;
}

const Tool& toolNamed(std::string_view name) {
  return *std::ranges::find_if(tools(), [&](const Tool& t) { return t.name == name; });
}

const Tool* sliceToolOfKey(int key) {
  const auto found =
      std::ranges::find_if(tools(), [&](const Tool& t) { return t.inSlices && key != 0 && t.key == key; });
  return found == tools().end() ? nullptr : &*found;
}

std::vector<const Tool*> chosenSceneTools() {
  std::vector<const Tool*> chosen;
  for (const Tool& tool : tools())
    if (tool.inScene && tool.key && !tool.draws()) chosen.push_back(&tool);
  return chosen;
}

FlatLook lookOf(const SlicePress& press) { return flatLookOf(press.session.workspace().view(press.view)); }

void editFlat(Session& session, ViewId view, const QString& text,
              const std::function<void(FlatLook&)>& change) {
  session.change(
      text,
      [&](Workspace& w) {
        ViewState& state = w.editView(view);
        change(state.flats.editOrAdd(state.series));
      },
      text);
}

void goToPlace(Session& session, ViewId view, const LoadedSeriesPtr& shown, int place) {
  session.change(tr("Scroll"), withPlace(session.workspace(), view, shown, place), tr("Scroll"));
}

void setCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                  const Crosshair& after) {
  const Crosshair before = crosshairOf(session.workspace(), view, series);
  session.change(
      text, withCrosshair(session.workspace(), view, frameOfReference(series.series), before, after), text);
}

void moveCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                   glm::dvec3 pPatient) {
  Crosshair after = crosshairOf(session.workspace(), view, series);
  after.at = pPatient;
  setCrosshair(session, view, series, text, after);
}

void zoomFlat(Session& session, ViewId view, const FlatLook& from, const SlicePlane& plane, glm::dvec3 fixed,
              double factor) {
  const double zoom = std::clamp(from.zoom * factor, leastZoom, mostZoom);
  const glm::dvec3 offset = fixed - plane.centre;
  const glm::dvec2 fixedMm =
      from.panMm + glm::dvec2(glm::dot(offset, plane.right), glm::dot(offset, plane.down));
  editFlat(session, view, tr("Zoom"), [&](FlatLook& look) {
    look.zoom = zoom;
    look.panMm = fixedMm + (from.panMm - fixedMm) * (from.zoom / zoom);
  });
}

}  // namespace volumen
