#include "ui/views/slice_view.h"

#include <QPainter>
#include <cmath>

#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/derived_objects.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/cine_bar.h"
#include "ui/views/clip_lines.h"
#include "ui/views/colour_bar.h"
#include "ui/views/cross_lines.h"
#include "ui/widgets/colours.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

constexpr double segmentOpacity = 0.5;
constexpr int beyondAnyEnd = 1 << 24;  // steps

// Returns the value of the voxel at a point, with its unit; empty outside the volume. A layout along a curve
// extends beyond its source.
QString valueAt(const LoadedSeries& shown, glm::dvec3 p) {
  const Volume& volume = *shown.volume;
  const glm::ivec3 voxel(glm::floor(volume.geometry().voxelFromPatient(p) + 0.5));
  if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(voxel, volume.size())))
    return {};
  const float value = volume.value(voxel.x, voxel.y, voxel.z);
  if (shown.series.curved && isPadding(volume.attributes().padding, value))
    return SliceView::tr("outside the series");
  return valueText(shown, value);
}

}  // namespace

// Shows every slice, however long it takes to draw.
class SliceView::Stack : public Playable {
 public:
  explicit Stack(SliceView& view) : view_(view) {}

  QString noun() const override { return tr("Slice"); }
  int count() const override { return view_.shown() ? view_.place().count : 0; }
  int place() const override { return view_.place().index; }
  int numberCount() const override { return isOfFile() ? view_.shown()->series.acquired.size.z : count(); }
  int numberOf(int place) const override {
    if (!view_.isAlongSlices()) return place + 1;
    const int slice = countsDown() ? count() - 1 - place : place;
    if (!isOfFile()) return slice + 1;
    const std::vector<int>& copies = view_.shown()->series.regular->copies;
    return slice >= 0 && slice < int(copies.size()) ? copies[std::size_t(slice)] + 1 : 0;
  }
  int number() const override { return view_.numbers().now; }
  std::optional<int> placeOf(int number) const override { return view_.placeOf(number); }
  SeriesKey source() const override { return view_.state().series; }
  Cine cine() const override { return {view_.seriesState().series->cine.framesPerSecond, {}, false}; }
  void begin(int steps) override { stepsBefore_ = steps; }
  void goTo(int place) override { view_.moveTo(place); }
  void play(int place) override {
    view_.session_.playOn(stepsBefore_, [this, place] { goTo(place); });
  }
  bool isReady(int) const override { return view_.isAtRest(); }

 private:
  // Returns whether slices are uneven or missing, so that drawn slices differ from those of the file.
  bool isOfFile() const { return view_.isAlongSlices() && view_.shown()->series.regular; }
  // The file may number its slices against the wheel direction.
  bool countsDown() const {
    Crosshair first = crosshairOf(view_.session_.workspace(), view_.id(), *view_.shown());
    first.at = view_.pointOn(0);
    return stackPlace(view_.shown()->volume->geometry(), view_.state().kind, first).index > 0;
  }

  SliceView& view_;
  int stepsBefore_ = 0;  // index of the undo stack when playback began
};

SliceView::SliceView(const ViewParts& parts, ViewId id, QWidget* parent) : FlatView(parts, id, parent) {
  setObjectName(QStringLiteral("sliceView%1").arg(id));
  cine_->add(std::make_unique<Stack>(*this), false);
  tellWarnings();
}

LoadedSeriesPtr SliceView::shown() const { return showsSlices(state().kind) ? series() : nullptr; }

SliceRequest SliceView::requestOf(const SlicePlane& plane) const {
  const LoadedSeriesPtr shown = this->shown();
  const FlatLook look = flatLookOf(state());
  GreyMapping grey = greyMapping(greyWindow(), *shown);
  grey.inverted = grey.inverted != look.inverted;
  std::vector<SliceLayer> layers{{shown->volume, grey, seriesState().colours}};
  const Workspace& workspace = session_.workspace();
  if (const LoadedSeriesPtr over = session_.seriesNamed(look.overlay))
    if (const auto relation =
            relationOf(workspace, frameOfReference(*seriesState().series), frameOfReference(over->series)))
      layers.push_back({over->volume,
                        greyMapping(overlayWindow(workspace.series.at(look.overlay), *over), *over),
                        look.overlayColours, look.overlayOpacity, relation->toFromFrom});
  if (segment_ && segment_->volume == shown->volume)
    layers.push_back({segment_->volume, {}, {}, segmentOpacity, {}, TintedRange{segment_->range, rangeTint}});
  return {id(), std::move(layers), plane, nullptr, look.layers, segmentLayers()};
}

Window SliceView::greyWindow() const { return flatWindow(seriesState(), *shown()); }

// Kept on screen until the slice of the new time point is drawn.
bool SliceView::keepsPictureOf(const SeriesKey& before) const {
  const auto& all = session_.workspace().series;
  const auto from = all.find(before), to = all.find(state().series);
  return from != all.end() && to != all.end() && areTimePoints(*from->second.series, *to->second.series);
}

void SliceView::seriesExchanged(bool another) {
  if (another)
    forget();
  else
    tellWarnings();
}

FlatView::Warnings SliceView::warnings() const {
  Warnings warnings;
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return warnings;
  for (const std::string& text : shortWarnings(shown->warnings))
    warnings.words << QString::fromStdString(text);
  for (const Warning& w : changingPicture(shown->warnings)) warnings.sentences << shownText(w.sentence);
  return warnings;
}

void SliceView::showSegment(const std::optional<VolumeRange>& segment) {
  segment_ = segment;
  askForPicture();
}

void SliceView::setClipShown(bool shown) {
  clipShown_ = shown;
  update();
}

void SliceView::scroll(int steps) {
  if (steps != 0) goTo(place().index + steps);
}

void SliceView::goTo(int place) {
  stop();
  moveTo(place);
}

void SliceView::moveTo(int place) {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return;
  const Crosshair crosshair = crosshairOf(session_.workspace(), id(), *shown);
  moveCrosshair(session_, id(), *shown, tr("Scroll"),
                scrolled(shown->volume->geometry(), state().kind, crosshair, place - this->place().index));
}

StackPlace SliceView::place() const {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return {};
  return stackPlace(shown->volume->geometry(), state().kind, crosshairOf(session_.workspace(), id(), *shown));
}

// An oblique plane has no acquired slices to go to.
bool SliceView::isAlongSlices() const {
  return shown() && onSlice(*plane(), shown()->volume->geometry(), 0).has_value();
}

// Returns the crosshair's point moved onto a slice of the drawn grid.
glm::dvec3 SliceView::pointOn(int slice) const {
  const LoadedSeriesPtr shown = this->shown();
  const VoxelGeometry& geometry = shown->volume->geometry();
  glm::dvec3 pVoxel = geometry.voxelFromPatient(crosshairOf(session_.workspace(), id(), *shown).at);
  pVoxel.z = slice;
  return geometry.patientFromVoxel(pVoxel);
}

// Acquired slices have the numbers of the file, which may run against the wheel direction.
FlatView::Numbers SliceView::numbers() const {
  if (!isAlongSlices()) return {tr("Slice"), place().index + 1, place().count};
  SlicePlane thin = *plane();
  thin.slabMm = 0;
  const Series& series = shown()->series;
  const PictureSeen seen = volumen::pictureSeen(series, shown()->volume->geometry(), thin);
  return {tr("Slice"), seen.index.value_or(-1) + 1, series.acquired.size.z};
}

QString SliceView::numberLine() const {
  const LoadedSeriesPtr shown = this->shown();
  return planeNumber(shown->series, shown->volume->geometry(), state().kind,
                     crosshairOf(session_.workspace(), id(), *shown), *plane())
      .text;
}

std::optional<int> SliceView::placeOf(int number) const {
  if (!isAlongSlices()) return number - 1;
  const std::optional<int> slice = drawnSlice(shown()->series, number - 1);
  if (!slice) return {};
  Crosshair at = crosshairOf(session_.workspace(), id(), *shown());
  at.at = pointOn(*slice);
  return stackPlace(shown()->volume->geometry(), state().kind, at).index;
}

QString SliceView::goToNumber(int number) {
  if (!isAlongSlices()) {
    goTo(number - 1);
    return {};
  }
  const std::optional<int> slice = drawnSlice(shown()->series, number - 1);
  if (!slice) return tr("Slice %1 is not in the volume: choose View > Show as frames.").arg(number);
  stop();
  moveCrosshair(session_, id(), *shown(), tr("Scroll"), pointOn(*slice));
  return {};
}

std::vector<int> SliceView::keyImagePlaces() const {
  std::vector<int> places;
  if (!isAlongSlices()) return places;
  for (const int index : keyImagesOf(session_.workspace(), shown()->series))
    if (const std::optional<int> place = placeOf(index + 1)) places.push_back(*place);
  return places;
}

void SliceView::makeThicker(int steps) {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown || steps == 0) return;
  const double step = wheelStep(shown->volume->geometry(), plane()->normal());
  editFlat(session_, id(), tr("Slab"), [&](FlatLook& look) {
    look.slabMm = std::clamp(std::round(look.slabMm / step + steps) * step, 0.0, 500.0);
  });
}

Workspace SliceView::unturned(Workspace workspace) const {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return workspace;
  const Crosshair before = crosshairOf(workspace, id(), *shown);
  if (!before.byHand) return workspace;
  return withCrosshair(std::move(workspace), id(), frameOfReference(shown->series), before, {before.at});
}

std::vector<FlatView::WindowChoice> SliceView::windows() const {
  const LoadedSeriesPtr shown = this->shown();
  std::vector<WindowChoice> all;
  if (!shown) return all;
  for (const NamedWindow& choice : windowChoices(*shown, session_.preferences().windows))
    all.push_back({choice.name, choice.window == seriesState().window, choice.key});
  return all;
}

void SliceView::chooseWindow(int number) {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return;
  const std::vector<NamedWindow> choices = windowChoices(*shown, session_.preferences().windows);
  if (number >= int(choices.size())) return;
  session_.change(tr("Window"),
                  [&](Workspace& w) { setWindow(w, id(), choices[std::size_t(number)].window); });
}

PictureSeen SliceView::pictureSeen() const {
  const LoadedSeriesPtr shown = this->shown();
  return shown ? volumen::pictureSeen(shown->series, shown->volume->geometry(), *plane()) : PictureSeen();
}

std::vector<const Measurement*> SliceView::measurements() const {
  return measurementsIn(session_.workspace(), frameOfReference(shown()->series));
}

std::unique_ptr<Drag> SliceView::pressLine(const SlicePress& press) const {
  if (const std::optional<ColourBar> bar = colourBar())
    if (std::unique_ptr<Drag> drag = beginBarEnd(session_, rect(), *bar, press.at)) return drag;
  std::unique_ptr<Drag> drag = beginOnLines(press, hasCrosshairTool());
  return drag ? std::move(drag) : beginOnClip(press, clipShown_);
}

bool SliceView::isOnLine(const SlicePress& press) const {
  if (colourBar() && isOnBarEnd(rect(), press.at)) return true;
  return isOnLines(press, hasCrosshairTool()) || isOnClip(press, clipShown_);
}

QString SliceView::hoverText(QPointF position) const {
  const auto press = pressAt(position);
  if (!press) return {};
  const glm::dvec3 p = press->patientAt(position);
  QString text = valueAt(*press->series, p);
  if (text.isEmpty()) return {};
  if (const LoadedSeriesPtr over = session_.seriesNamed(flatLookOf(state()).overlay)) {
    const auto relation = relationOf(session_.workspace(), frameOfReference(press->series->series),
                                     frameOfReference(over->series));
    const QString second = relation ? valueAt(*over, relation->toFromFrom(p)) : QString();
    if (!second.isEmpty()) text += QStringLiteral(" | ") + second;
  }
  return press->series->volume->geometry().calibrated
             ? text + tr(" at %1").arg(placeText(press->series->series, p))
             : text;
}

Overlays SliceView::overlays() const {
  const LoadedSeriesPtr shown = this->shown();
  const SlicePlane now = *plane();
  const Workspace& workspace = session_.workspace();
  const FlatLook look = flatLookOf(state());
  const Window window = flatWindow(seriesState(), *shown);
  CornerTexts texts = slicesCorner(workspace, id(), *shown, now);
  if (const LoadedSeriesPtr over = session_.seriesNamed(look.overlay))
    texts.add(CornerItem::overlay,
              tr("with %1, %2 %").arg(seriesText(over->series)).arg(std::lround(100 * look.overlayOpacity)));
  texts.add(CornerItem::mark, keyImageText());
  Overlays o = cornersOf(texts);
  o.bottomRight = windowLine(namedWindow(window, shown->series, session_.preferences().windows));
  if (!shown->volume->geometry().calibrated) return o;
  const auto letters = [known = knowsSides(shown->series)](glm::dvec3 d) {
    return known ? QString::fromStdString(sideLetters(d)) : QString();
  };
  o.right = letters(now.right);
  o.left = letters(-now.right);
  o.bottom = letters(now.down);
  o.top = letters(-now.down);
  o.mmPerPixel = now.mmPerPixel * devicePixelRatioF();
  return o;
}

bool SliceView::hasCrosshairTool() const { return &tool() == &toolNamed("crosshair"); }

std::vector<FlatView::StackPlane> SliceView::stackPlanesIn(const Workspace& workspace, bool ends) const {
  std::vector<StackPlane> planes = FlatView::stackPlanesIn(workspace, ends);
  const LoadedSeriesPtr shown = this->shown();
  if (planes.empty() || !ends) return planes;
  const Crosshair crosshair = crosshairOf(workspace, id(), *shown);
  for (const auto& [part, steps] :
       {std::pair(StackPart::first, -beyondAnyEnd), {StackPart::last, beyondAnyEnd}}) {
    SlicePlane plane = planes.front().plane;
    plane.centre += scrolled(shown->volume->geometry(), state().kind, crosshair, steps) - crosshair.at;
    planes.push_back({part, plane});
  }
  return planes;
}

// Paints the lines of the clip box and of the other planes.
void SliceView::paintLines(QPainter& painter) const {
  FlatView::paintLines(painter);
  const SlicePress here = *pressAt({});
  paintClipLines(painter, clipLines(here, clipShown_));
  paintCrossLines(painter, crossLines(here),
                  here.pixelAt(crosshairOf(session_.workspace(), id(), *shown()).at), rect());
}

}  // namespace volumen
