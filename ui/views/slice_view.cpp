#include "ui/views/slice_view.h"

#include <cmath>

#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "results/text/value_text.h"
#include "ui/controller/derived_objects.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/cine_bar.h"
#include "ui/widgets/colours.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

constexpr double segmentOpacity = 0.5;

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
class SliceView::Slices : public Playable {
 public:
  explicit Slices(SliceView& view) : view_(view) {}

  Stack stack() const override { return view_.stack(); }
  SeriesKey source() const override { return view_.state().series; }
  Cine cine() const override { return {view_.seriesState().series->cine.framesPerSecond, {}, false}; }
  void begin(int steps) override { stepsBefore_ = steps; }
  void goTo(int place) override { view_.moveTo(place); }
  void play(int place) override {
    view_.session_.playOn(stepsBefore_, [this, place] { goTo(place); });
  }
  bool isReady(int) const override { return view_.isAtRest(); }

 private:
  SliceView& view_;
  int stepsBefore_ = 0;  // index of the undo stack when playback began
};

SliceView::SliceView(const ViewParts& parts, ViewId id, QWidget* parent) : FlatView(parts, id, parent) {
  setObjectName(QStringLiteral("sliceView%1").arg(id));
  cine_->add(std::make_unique<Slices>(*this), false);
  tellWarnings();
}

LoadedSeriesPtr SliceView::shown() const { return showsSlices(state().kind) ? series() : nullptr; }

SliceRequest SliceView::requestOf(const SlicePlane& plane) const {
  const LoadedSeriesPtr shown = this->shown();
  const FlatLook look = flatLookOf(state());
  GreyMapping grey = greyMapping(flatWindow(seriesState(), *shown), *shown);
  grey.inverted = grey.inverted != look.inverted;
  std::vector<SliceLayer> layers{{shown->volume, grey, seriesState().colours}};
  const Workspace& workspace = session_.workspace();
  if (const LoadedSeriesPtr over = session_.seriesNamed(look.overlay))
    if (const auto relation =
            relationOf(workspace, frameOfReference(*seriesState().series), frameOfReference(over->series)))
      layers.push_back({over->volume,
                        greyMapping(overlayWindow(workspace.series.at(look.overlay), *over), *over),
                        look.overlayColours, look.overlayOpacity, relation->toFromFrom});
  if (const auto& segment = highlights_.segment; segment && segment->volume == shown->volume)
    layers.push_back({segment->volume, {}, {}, segmentOpacity, {}, TintedRange{segment->range, rangeTint}});
  return {id(), std::move(layers), plane, nullptr, look.layers, segmentLayers()};
}

std::optional<Window> SliceView::windowShown() const {
  const LoadedSeriesPtr shown = this->shown();
  return shown ? std::optional(flatWindow(seriesState(), *shown)) : std::nullopt;
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

std::vector<FlatView::WindowChoice> SliceView::windows() const {
  const LoadedSeriesPtr shown = this->shown();
  std::vector<WindowChoice> all;
  if (!shown) return all;
  const SeriesState now = seriesState();
  for (const NamedWindow& choice : windowChoices(*shown, session_.preferences().windows))
    all.push_back({choice.name, choice.window == now.window, choice.key, {choice.window, now.namedGrey}});
  return all;
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
  o.number = texts.text(CornerItem::number);
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

}  // namespace volumen
