#include "tests/ui/turned_sequence.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/test_series.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/time_points.h"

namespace volumen::tests {

namespace {

constexpr double markValue = 1000;
constexpr ViewId compared[] = {firstComparedId, firstComparedId + 1, firstComparedId + 2,
                               firstComparedId + 3};
constexpr ViewKind kindOf[] = {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal};

// Returns a grid as a scanner may acquire it: nearly straight, clearly tilted, or as slices of another plane.
glm::dmat3 gridSteps(Chance& chance, glm::dvec3 spacing, bool mayTurn) {
  const double angles[] = {0, 0.05, 0.15, 0.7};
  const double angle = angles[chance.below(mayTurn ? 4 : 3)];
  glm::dmat3 lying(glm::rotate(glm::dmat4(1), angle, glm::normalize(chance.vector() + glm::dvec3(0.01))));
  if (mayTurn && chance.oneIn(3))  // sagittal slices
    lying = lying * glm::dmat3({0, 1, 0}, {0, 0, -1}, {-1, 0, 0});
  if (chance.oneIn(4)) lying[2] = -lying[2];  // the first slice is the uppermost
  return {lying[0] * spacing.x, lying[1] * spacing.y, lying[2] * spacing.z};
}

// Returns a series with bright voxels at patient positions that no turn maps onto each other. The background
// grows along all axes, or is empty for an overlay.
std::shared_ptr<LoadedSeries> markedSeries(glm::ivec3 size, glm::dmat3 steps, glm::dvec3 centre,
                                           double ground, const char* name, std::vector<glm::dvec3>& marks) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.geometry.patientFromVoxelStep = steps;
  parts.geometry.origin = centre - steps * ((glm::dvec3(size) - 1.0) / 2.0);
  std::vector<std::int16_t> values;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) values.push_back(std::int16_t(ground * (10 + 4 * i + 7 * j + 12 * k)));
  const glm::dvec3 at[] = {{0.5, 0.5, 0.5},  {0.2, 0.3, 0.5}, {0.8, 0.35, 0.5},
                           {0.3, 0.75, 0.3}, {0.7, 0.6, 0.8}, {0.5, 0.2, 0.7}};
  for (const glm::dvec3 share : at) {
    const glm::ivec3 voxel(share * glm::dvec3(size - 1) + 0.5);
    values[std::size_t((voxel.z * size.y + voxel.y) * size.x + voxel.x)] = std::int16_t(markValue);
    marks.push_back(parts.geometry.patientFromVoxel(glm::dvec3(voxel)));
  }
  parts.values = std::move(values);
  auto series = std::make_shared<LoadedSeries>(*ballSeries(2, 1));
  series->volume = volumeFrom(std::move(parts));
  series->series.acquired = series->volume->geometry();
  series->series.frameOfReferenceUid = "1.2.3.4";
  series->series.description = name;
  series->window = {500, 1000};
  return series;
}

double greyOf(const Volume& volume, const TwinSeen& seen, glm::ivec2 pixel, glm::dvec3 shift) {
  const double value = twinPixel(volume, seen, pixel, shift);
  return std::isnan(value) ? value : std::floor(twinGrey(value, {500, 1000}, false) + 0.5);
}

// Returns whether rounding decides.
bool isOnEdge(double depth, double half) { return std::abs(std::abs(depth) - half) < 1e-3; }

QString placeSaid(glm::dvec2 p) { return QStringLiteral("(%1, %2)").arg(p.x, 0, 'f', 3).arg(p.y, 0, 'f', 3); }

}  // namespace

TurnedSequence::TurnedSequence(int seed) : RandomWalk(seed), marks_(2) {
  const glm::dvec3 centre(chance_.between(-40, 40), chance_.between(-40, 40), chance_.between(-40, 40));
  const glm::dmat3 grid = gridSteps(chance_, {1, 1.2, 2.5}, true);
  // Time points have different backgrounds.
  std::vector<const Series*> open;
  for (const double ground : {1.0, 0.5, 1.6}) {
    marks_[0].clear();
    const auto step = markedSeries({34, 27, 15}, grid, centre, ground, "First", marks_[0]);
    step->series.seriesUid = "1.2.3.4.5";
    step->series.timePoint = std::to_string(1 + open.size());
    open.push_back(&step->series);
    (series_.empty() ? series_ : later_).push_back(step);
  }
  const glm::dmat3 other = gridSteps(chance_, {2.6, 2.1, 4}, false);
  series_.push_back(
      markedSeries({17, 19, 11}, other, centre + 4.0 * chance_.vector(), 0, "Second", marks_[1]));
  for (const LoadedSeriesPtr& s : series_) twin_.volumes.push_back(s->volume);
  session().show(series_[0]);
  session().change({}, withTimePointsOf(workspace(), series_[0]->series, open));
  for (const LoadedSeriesPtr& step : later_) session().keep(step);
  child<QAction>("layoutFour")->trigger();
  const int shown[] = {0, 1, 0, 1};
  const TwinKind kinds[] = {twinAxial, twinAxial, twinCoronal, twinSagittal};
  for (int n = 0; n < 4; ++n) {
    session().show(series_[std::size_t(shown[n])], compared[n]);
    session().showAs(compared[n], kindOf[kinds[n]]);
    twin_.views[compared[n]] = {.series = shown[n], .kind = kinds[n]};
  }
  if (chance_.oneIn(2)) child<QAction>("layoutPlanes")->trigger();
  for (const TwinKind kind : {twinAxial, twinCoronal, twinSagittal})
    twin_.views[axialViewId + kind] = {.series = 0, .kind = kind};
  QCoreApplication::processEvents();
  look();
  twin_.shared.at = crosshairOf(workspace(), *series_[0]).at;
  begin();
}

// Notes which views of slices are on screen, and their sizes.
void TurnedSequence::look() {
  QCoreApplication::processEvents();
  twin_.onScreen.clear();
  for (const ViewId id : viewsOnScreen(workspace()))
    if (const SliceView* shown = view(id); shown && showsSlices(workspace().view(id).kind)) {
      twin_.onScreen.push_back(id);
      twin_.sizes[id] = {shown->pixels().width(), shown->pixels().height()};
    }
}

void TurnedSequence::take(const TurnedTwin& twin) {
  const auto sizes = twin_.sizes;
  twin_ = twin;
  for (const auto& [id, size] : sizes) twin_.sizes[id] = size;
  look();
}

QString TurnedSequence::wrong() {
  if (!fault_.isEmpty()) return fault_;
  look();
  for (const ViewId id : twin_.onScreen)
    if (const QString why = wrongIn(id); !why.isEmpty())
      return QStringLiteral("view %1 (%2 of %3): %4")
          .arg(id)
          .arg(QLatin1String(rowOf(workspace().view(id).kind).word),
               QLatin1String(twin_.views.at(id).series ? "Second" : "First"), why);
  return {};
}

QString TurnedSequence::wrongIn(ViewId id) {
  for (const auto check : {&TurnedSequence::wrongPlace, &TurnedSequence::wrongTexts,
                           &TurnedSequence::wrongShapes, &TurnedSequence::wrongPicture})
    if (const QString why = (this->*check)(id); !why.isEmpty()) return why;
  return {};
}

// Positions agree within 1/100 of a pixel, and 1/1000 mm along the normal.
QString TurnedSequence::wrongPlace(ViewId id) {
  const TwinSeen seen = twin_.seen(id);
  const std::optional<SlicePlane> plane = view(id)->plane();
  if (!plane) return QStringLiteral("no plane");
  for (const std::vector<glm::dvec3>& marks : marks_)
    for (const glm::dvec3 p : marks) {
      const glm::dvec2 expected = seen.placeOf(p), is = plane->pixelFromPatient(p);
      if (!(glm::distance(expected, is) < 0.01))
        return QStringLiteral("a place at %1 instead of %2").arg(placeSaid(is), placeSaid(expected));
      const double deep = seen.depthOf(p),
                   isDeep = glm::dot(p - plane->centre, glm::cross(plane->right, plane->down));
      if (!(std::abs(deep - isDeep) < 1e-3))
        return QStringLiteral("%1 mm deep instead of %2").arg(isDeep).arg(deep);
    }
  return {};
}

QString TurnedSequence::wrongTexts(ViewId id) {
  const TwinSeen seen = twin_.seen(id);
  const Overlays o = view(id)->overlays();
  const QStringList is{o.left, o.right, o.top, o.bottom};
  const QStringList expected{twinLetters(-seen.right), twinLetters(seen.right), twinLetters(-seen.down),
                             twinLetters(seen.down)};
  if (is != expected)
    return QStringLiteral("letters %1 instead of %2")
        .arg(is.join(QLatin1Char(' ')), expected.join(QLatin1Char(' ')));
  const auto lineWith = [&](const char* pattern) {
    const QStringList found = o.topRight.filter(QRegularExpression(QLatin1String(pattern)));
    return found.isEmpty() ? QString() : found.front();
  };
  if (const QString line = lineWith("\\d / \\d"); line != twin_.number(id))
    return QStringLiteral("\"%1\" instead of \"%2\"").arg(line, twin_.number(id));
  const QString place = lineWith("^([RLAPSI] [\\d.]+ mm|0 mm|oblique)$");  // if there is space
  if (!place.isEmpty() && place != twin_.position(id))
    return QStringLiteral("\"%1\" instead of \"%2\"").arg(place, twin_.position(id));
  const TwinLook& look = twin_.views.at(id);
  const QString step = look.series == 0
                           ? QStringLiteral("time point %1 of %2").arg(look.time + 1).arg(later_.size() + 1)
                           : QString();
  // These lines stay longer than the position does.
  for (const auto& [line, said] :
       {std::pair(lineWith("^time point "), step), {lineWith("^(MIP|MinIP|Mean) "), twin_.slab(id)}})
    if (line != said && !(line.isEmpty() && place.isEmpty()))
      return QStringLiteral("\"%1\" instead of \"%2\"").arg(line, said);
  if (std::abs(o.mmPerPixel / seen.mmPerPixel - 1) > 1e-9) return QStringLiteral("another scale");
  return {};
}

const Volume& TurnedSequence::volumeOf(const TwinLook& look) const {
  return *(look.time == 0 ? series_[std::size_t(look.series)] : later_[std::size_t(look.time - 1)])->volume;
}

// Returns the expected green on a scale of 0 to 255, by slices.md 1 and 3. The overlay is hot iron at half
// opacity, visible from a quarter of its range.
int TurnedSequence::expectedGreen(const TwinSeen& seen, const TwinLook& look, glm::ivec2 pixel,
                                  glm::dvec3 shift) {
  const double grey = greyOf(volumeOf(look), seen, pixel, shift);
  const double under = std::isnan(grey) ? 0 : look.inverted ? 255 - grey : grey;
  if (look.over < 0) return int(under);
  const double over = greyOf(*series_[std::size_t(look.over)]->volume, seen, pixel, shift);
  if (std::isnan(over)) return int(under);
  const double part = 0.5 * std::min(1.0, over / 64);
  return int(
      std::lround(under + part * (qGreen(colourTable(ColourMap::hotIron)[std::size_t(over)]) - under)));
}

// Compares the picture on screen once it is that of the workspace, at marks near the plane and at random
// positions. Interpolation may round by two grey levels. If rounding decides at the volume's edge, either
// value is right.
QString TurnedSequence::wrongPicture(ViewId id) {
  SliceView* const shown = view(id);
  QImage picture;
  const auto isThere = [&] {
    const auto drawn = drawSlice(*shown->requestFor(shown->pixels()));
    picture = shown->picture().convertToFormat(QImage::Format_RGB32);
    return drawn && picture == drawn->convertToFormat(QImage::Format_RGB32);
  };
  if (!isThere() && !QTest::qWaitFor(isThere, 5000)) return QStringLiteral("the picture does not come");
  const QImage captured = shown->capture();
  if (captured.size() != picture.size()) return QStringLiteral("captured at another size");
  int covered = 0;  // covered by texts and lines
  for (int n = 0; n < 40; ++n) {
    const QPoint p(chance_.below(picture.width()), chance_.below(picture.height()));
    covered += captured.pixelColor(p) != picture.pixelColor(p);
  }
  if (covered > 30) return QStringLiteral("another picture is captured");
  const TwinSeen seen = twin_.seen(id);
  const TwinLook& look = twin_.views.at(id);
  std::vector<glm::ivec2> pixels;
  for (const std::vector<glm::dvec3>& marks : marks_)
    for (const glm::dvec3 p : marks)
      if (std::abs(seen.depthOf(p)) < 1.5) pixels.emplace_back(glm::floor(seen.placeOf(p)));
  for (int n = 0; n < 8; ++n) pixels.emplace_back(chance_.below(seen.size.x), chance_.below(seen.size.y));
  for (const glm::ivec2 p : pixels) {
    if (p.x < 0 || p.y < 0 || p.x >= seen.size.x || p.y >= seen.size.y) continue;
    const int is = qGreen(picture.pixel(p.x, p.y)), expected = expectedGreen(seen, look, p, glm::dvec3(0));
    bool isRight = std::abs(is - expected) <= 2;
    for (const double shift : {-1e-6, 1e-6})
      isRight = isRight || std::abs(is - expectedGreen(seen, look, p, glm::dvec3(shift))) <= 2;
    if (!isRight)
      return QStringLiteral("pixel %1 is %2 instead of %3")
          .arg(placeSaid(glm::dvec2(p)))
          .arg(is)
          .arg(expected);
  }
  return {};
}

// The part of a line within half a wheel step is drawn. A rectangle is drawn completely in its own plane.
// Ends agree within half a pixel, and the text of a complete shape stays.
QString TurnedSequence::wrongShapes(ViewId id) {
  SliceView* const shown = view(id);
  if (!shown->isMeasured() && !QTest::qWaitFor([&] { return shown->isMeasured(); }, 5000))
    return QStringLiteral("not measured");
  const TwinSeen seen = twin_.seen(id);
  const double half = twinStep(twin_.geometry(id), glm::cross(seen.right, seen.down)) / 2;
  const std::vector<DrawnMeasurement> drawn = shown->drawnMeasurements();
  for (const TwinShape& shape : twin_.shapes) {
    const auto found = std::ranges::find(drawn, shape.id, &DrawnMeasurement::id);
    const double from = seen.depthOf(shape.from), to = seen.depthOf(shape.to);
    const bool isWhole = std::max(std::abs(from), std::abs(to)) < (shape.isLine ? half : 1e-6);
    if (isOnEdge(from, half) || isOnEdge(to, half) || (!shape.isLine && !isWhole)) continue;
    const auto reaches = [&](double depth) { return std::clamp(depth, -half, half); };
    const bool isSeen = isWhole || reaches(from) != reaches(to);
    if (isSeen != (found != drawn.end()))
      return isSeen ? QStringLiteral("a shape is not drawn") : QStringLiteral("a shape is drawn");
    if (!isSeen) continue;
    const auto isDrawnAt = [&](double t) {
      const glm::dvec2 at =
          seen.placeOf(shape.from + t * (shape.to - shape.from)) / shown->devicePixelRatioF();
      for (const QPolygonF& line : found->lines)
        for (const QPointF corner : line)
          if (glm::distance(at, glm::dvec2(corner.x(), corner.y())) < 0.5) return true;
      return false;
    };
    const auto share = [&](double depth) { return (reaches(depth) - from) / (to - from); };
    if (!isDrawnAt(isWhole ? 0 : share(from)) || !isDrawnAt(isWhole ? 1 : share(to)))
      return QStringLiteral("an end of a shape is elsewhere");
    if (isWhole && found->text.value(0) != shape.said)
      return QStringLiteral("says \"%1\" instead of \"%2\"").arg(found->text.value(0), shape.said);
  }
  return {};
}

}  // namespace volumen::tests
