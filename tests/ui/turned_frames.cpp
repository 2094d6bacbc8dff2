#include "tests/ui/turned_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "results/series/series_facts.h"
#include "tests/fixtures/slice_twin.h"
#include "tests/fixtures/small_volumes.h"
#include "ui/controller/slice_service.h"
#include "ui/workspace/hanging_protocol.h"

namespace volumen::tests {

namespace {

const glm::dmat2 quarter{{0, 1}, {-1, 0}}, mirror{{-1, 0}, {0, 1}};

// Returns the effect of a presentation state on positions of the picture.
glm::dmat2 turnOf(const TwinState& state) {
  glm::dmat2 turn(1);
  for (int n = 0; n < state.quarters; ++n) turn = quarter * turn;
  return state.mirrored ? mirror * turn : turn;
}

// Returns the letter of a picture's side, if the file states it. Feet are inferior.
QString letterOf(const Breast& breast, glm::dvec2 alongPicture) {
  if (breast.rowsTo[0] == 0) return {};
  const QStringList sides =
      QString::fromLatin1(breast.rowsTo).replace(QLatin1Char('F'), QLatin1Char('I')).split(QLatin1Char('\\'));
  const bool isRow = std::abs(alongPicture.x) > 0.5;
  const QString to = sides[isRow ? 0 : 1];
  if ((isRow ? alongPicture.x : alongPicture.y) > 0) return to;
  const QString all = QStringLiteral("LRAPSI"), opposite = QStringLiteral("RLPAIS");
  return opposite.at(all.indexOf(to));
}

QString inPixels(glm::dvec2 p) { return QStringLiteral("(%1, %2)").arg(p.x, 0, 'f', 3).arg(p.y, 0, 'f', 3); }

}  // namespace

glm::dvec2 TurnedFrames::Seen::placeOf(glm::dvec2 pixel) const {
  return size / 2.0 + (seen * ((pixel - centre) * spacing) - middle) / mmPerPixel;
}

glm::dvec2 TurnedFrames::Seen::pixelAt(glm::dvec2 place) const {
  return centre + glm::transpose(seen) * ((place - size / 2.0) * mmPerPixel + middle) / spacing;
}

TurnedFrames::TurnedFrames(int seed) : RandomWalk(seed) {
  if (!write()) qFatal("cannot write pictures");
  window.open({folder_.path()});
  if (isClip_) showClip();
  const auto isHung = [&] {
    look();
    return onScreen_.size() == 4 &&
           std::ranges::all_of(onScreen_, [&](ViewId id) { return view(id)->frame() != nullptr; });
  };
  if (!QTest::qWaitFor(isHung, longest)) fault_ = QStringLiteral("not hung");
  takeHung();
  wrong();  // waits
  begin();
}

void TurnedFrames::look() {
  QCoreApplication::processEvents();
  onScreen_.clear();
  for (const ViewId id : viewsOnScreen(workspace()))
    if (const FrameView* shown = view(id); shown && shown->isVisible() && !shown->state().series.empty()) {
      onScreen_.push_back(id);
      sizes_[id] = {shown->pixels().width(), shown->pixels().height()};
    }
}

// Hanging decides which picture is in which view (TestHanging), but not its orientation. Clips begin at the
// first frame.
void TurnedFrames::takeHung() {
  twin_.looks.clear();
  for (const ViewId id : onScreen_) {
    if (isClip_) {
      twin_.looks[id] = {.picture = 0};
      continue;
    }
    const SeriesPicture picture = pictureIn(workspace(), id);
    const ProjectionView is = projectionOf(*picture.series, picture.frame);
    for (int n = 0; n < 4; ++n)
      if (is.laterality == breasts[n].side && is.viewPosition == breasts[n].view)
        twin_.looks[id] = {.picture = n, .isFacing = true};
  }
}

// The displayed area is as large as the view. Without a state it is the whole picture, rounded up to its
// smaller spacing.
double TurnedFrames::fittedMm(const TwinFrameLook& look, glm::dvec2 size) {
  const TwinPicture& picture = pictures_[std::size_t(look.picture)];
  glm::dvec2 mm = glm::dvec2(picture.breast.columns, picture.breast.rows) * picture.spacing;
  const double least = std::min(picture.spacing.x, picture.spacing.y);
  mm = glm::ceil(mm / least - 1e-6) * least;
  glm::dmat2 turn = look.seen;
  if (look.state >= 0) {
    const TwinState& state = picture.states[std::size_t(look.state)];
    mm = (state.areaTo - state.areaFrom + 1.0) * picture.spacing;
    turn = turn * turnOf(state);
  }
  mm = glm::abs(turn * mm);
  return std::max(mm.x / size.x, mm.y / size.y);
}

TurnedFrames::Seen TurnedFrames::seen(ViewId id) {
  TwinFrameLook& look = twin_.looks.at(id);
  const TwinPicture& picture = pictures_[std::size_t(look.picture)];
  Seen s;
  s.size = sizes_.at(id), s.spacing = picture.spacing;
  const glm::dvec2 pixels(picture.breast.columns, picture.breast.rows);
  const bool isRight = picture.breast.side[0] == 'R';
  if (look.isFacing) {
    // All are equally large, with chest walls at the inner edges.
    double mm = 0;
    for (const auto& [other, l] : twin_.looks)
      if (std::ranges::find(onScreen_, other) != onScreen_.end())
        mm = std::max(mm, fittedMm({.picture = l.picture}, sizes_.at(other)));
    look.zoom = fittedMm({.picture = look.picture}, s.size) / mm;
    // The outer side is not below. The picture is mirrored if the wall would otherwise not be at the inner
    // edge.
    const QString to = QString::fromLatin1(picture.breast.rowsTo);
    const bool isUpsideDown = to.endsWith(QLatin1String(picture.breast.side));
    const bool facesAway = to.startsWith(QLatin1Char('P')) != isRight;
    look.seen = (facesAway == isUpsideDown ? glm::dmat2(1) : mirror) * (isUpsideDown ? -1.0 : 1.0);
    const double least = std::min(picture.spacing.x, picture.spacing.y);
    const double wide = std::ceil(pixels.x * picture.spacing.x / least - 1e-6) * least;
    const double beside = (wide - s.size.x * mm) / 2;
    look.middle = glm::transpose(look.seen) * glm::dvec2(isRight ? beside : -beside, 0);
    faced_[{onScreen_.size(), id, look.picture}].push_back(look);
  }
  s.seen = look.seen;
  s.centre = (pixels - 1.0) / 2.0;
  if (look.state >= 0) {
    const TwinState& state = picture.states[std::size_t(look.state)];
    s.seen = look.seen * turnOf(state);
    s.centre = (state.areaFrom + state.areaTo) / 2.0;
  }
  s.middle = look.seen * look.middle;
  s.mmPerPixel = fittedMm(look, s.size) / look.zoom;
  return s;
}

// Frames are read meanwhile. Chest walls and sizes follow once they are there.
QString TurnedFrames::wrong() {
  QString why;
  const auto isRight = [&] { return (why = wrongNow()).isEmpty(); };
  return isRight() || QTest::qWaitFor(isRight, 3000) ? QString() : why;
}

QString TurnedFrames::wrongNow() {
  if (!fault_.isEmpty()) return fault_;
  look();
  for (const ViewId id : onScreen_) {
    if (!twin_.looks.contains(id) || twin_.looks.at(id).picture < 0)
      return QStringLiteral("view %1 shows another picture").arg(id);
    if (const QString why = wrongIn(id); !why.isEmpty())
      return QStringLiteral("view %1 (%2 %3): %4")
          .arg(id)
          .arg(QLatin1String(pictures_[std::size_t(twin_.looks.at(id).picture)].breast.side),
               QLatin1String(pictures_[std::size_t(twin_.looks.at(id).picture)].breast.view), why);
  }
  return {};
}

// Compares positions within 1/100 of a pixel, letters and measurements.
QString TurnedFrames::wrongIn(ViewId id) {
  FrameView* const shown = view(id);
  if (!shown->frame() || !shown->plane()) return QStringLiteral("no frame");
  const TwinFrameLook& look = twin_.looks.at(id);
  const TwinPicture& picture = pictures_[std::size_t(look.picture)];
  const Seen s = seen(id);
  for (const glm::ivec2 mark : picture.marks) {
    const glm::dvec2 is =
        shown->plane()->pixelFromPatient(shown->frame()->geometry().patientFromVoxel({mark, 0}));
    if (!(glm::distance(is, s.placeOf(mark)) < 0.01))
      return QStringLiteral("a pixel at %1 instead of %2, %3 mm a pixel instead of %4")
          .arg(inPixels(is), inPixels(s.placeOf(mark)))
          .arg(shown->plane()->mmPerPixel)
          .arg(s.mmPerPixel);
  }
  const Overlays o = shown->overlays();
  const auto letter = [&](glm::dvec2 onScreen) {
    return letterOf(picture.breast, glm::transpose(s.seen) * onScreen);
  };
  const QString is = o.left + o.right + o.top + o.bottom;
  const QString expected = letter({-1, 0}) + letter({1, 0}) + letter({0, -1}) + letter({0, 1});
  if (is != expected) return QStringLiteral("letters %1 instead of %2").arg(is, expected);
  const QString number =
      isStack_ ? QStringLiteral("Frame %1 / 4").arg(look.picture + 1) : QStringLiteral("Frame 1 / 1");
  if (!o.topRight.contains(number)) return QStringLiteral("does not say ") + number;
  const std::vector<DrawnMeasurement> drawn = shown->drawnMeasurements();
  for (const TwinLine& line : twin_.lines) {
    const auto found = std::ranges::find(drawn, line.id, &DrawnMeasurement::id);
    if ((found != drawn.end()) != (line.picture == look.picture))
      return QStringLiteral("a line on another picture");
    if (found == drawn.end()) continue;
    const QPolygonF& ends = found->lines.front();
    const glm::dvec2 from(ends.front().x(), ends.front().y()), to(ends.back().x(), ends.back().y());
    if (glm::distance(from, s.placeOf(line.from)) > 0.5 || glm::distance(to, s.placeOf(line.to)) > 0.5)
      return QStringLiteral("a line's end is elsewhere");
    if (found->text.value(0) != line.said)
      return QStringLiteral("says \"%1\" instead of \"%2\"").arg(found->text.value(0), line.said);
  }
  return wrongPicture(id, s);
}

// Compares the screen at every mark and at random positions, in grey levels. Rounding may cause a difference
// of two.
QString TurnedFrames::wrongPicture(ViewId id, const Seen& s) {
  FrameView* const shown = view(id);
  const auto drawn = drawSlice(*shown->requestFor(shown->pixels()));
  const QImage picture = shown->picture().convertToFormat(QImage::Format_RGB32);
  if (!drawn || picture != drawn->convertToFormat(QImage::Format_RGB32))
    return QStringLiteral("the picture does not come");
  const TwinFrameLook& look = twin_.looks.at(id);
  const TwinPicture& of = pictures_[std::size_t(look.picture)];
  TwinPlane plane;
  plane.right = {s.seen[0][0], s.seen[1][0], 0}, plane.down = {s.seen[0][1], s.seen[1][1], 0};
  plane.size = glm::ivec2(s.size), plane.mmPerPixel = s.mmPerPixel, plane.average = true;
  const VoxelGeometry& g = of.values->geometry();
  plane.centre = g.origin + glm::dvec3(s.pixelAt(s.size / 2.0) * s.spacing, 0);
  Chance places(17);  // the same at every comparison
  std::vector<glm::ivec2> pixels;
  for (const glm::ivec2 mark : of.marks) pixels.emplace_back(glm::floor(s.placeOf(mark)));
  for (int n = 0; n < 8; ++n) pixels.emplace_back(places.below(plane.size.x), places.below(plane.size.y));
  for (const glm::ivec2 p : pixels) {
    if (p.x < 0 || p.y < 0 || p.x >= plane.size.x || p.y >= plane.size.y) continue;
    const int is = qGreen(picture.pixel(p.x, p.y));
    const auto isLike = [&](glm::dvec3 shift) {
      const double value = twinPixel(*of.values, plane, p, shift);
      const double grey = std::floor(twinGrey(value, {400, 800}, false) + 0.5);
      return std::abs(is - (std::isnan(value) ? 0 : look.inverted ? 255 - grey : grey)) <= 2;
    };
    if (!isLike({0, 0, 0}) && !isLike({1e-6, 1e-6, 0}) && !isLike({-1e-6, -1e-6, 0}))
      return QStringLiteral("pixel %1 is %2").arg(inPixels(glm::dvec2(p))).arg(is);
  }
  return {};
}

}  // namespace volumen::tests
