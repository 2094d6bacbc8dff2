#include <algorithm>
#include <cmath>

#include "tests/ui/turned_sequence.h"
#include "ui/views/cross_lines.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

QPointF pointAt(glm::dvec2 place) { return {place.x, place.y}; }

}  // namespace

auto TurnedSequence::acts() -> const std::vector<Act>& {
  static const std::vector<Act> all{{"turn", 5, &TurnedSequence::turns},
                                    {"pan", 3, &TurnedSequence::pans},
                                    {"zoom", 3, &TurnedSequence::zooms},
                                    {"scroll", 4, &TurnedSequence::scrolls},
                                    {"crosshair", 3, &TurnedSequence::movesCrosshair},
                                    {"turn planes", 2, &TurnedSequence::turnsPlanes},
                                    {"align planes", 1, &TurnedSequence::alignsPlanes},
                                    {"reset view", 1, &TurnedSequence::resetsView},
                                    {"layout", 2, &TurnedSequence::choosesLayout},
                                    {"plane", 1, &TurnedSequence::choosesKind},
                                    {"link", 2, &TurnedSequence::links},
                                    {"invert", 1, &TurnedSequence::inverts},
                                    {"overlay", 2, &TurnedSequence::overlays},
                                    {"measure", 2, &TurnedSequence::measures},
                                    {"time point", 3, &TurnedSequence::stepsInTime},
                                    {"play", 1, &TurnedSequence::plays},
                                    {"slab", 2, &TurnedSequence::makesThicker},
                                    {"slab mode", 1, &TurnedSequence::choosesSlab},
                                    {"own pixels", 1, &TurnedSequence::showsOwnPixels},
                                    {"number", 2, &TurnedSequence::typesNumber},
                                    {"keys", 2, &TurnedSequence::movesFocus},
                                    {"resize", 1, &TurnedSequence::resizes},
                                    {"undo", 3, &TurnedSequence::undoes},
                                    {"redo", 2, &TurnedSequence::redoes}};
  return all;
}

ViewId TurnedSequence::anyView() {
  look();
  if (twin_.onScreen.empty()) child<QAction>("layoutPlanes")->trigger(), look();
  return twin_.onScreen[std::size_t(chance_.below(int(twin_.onScreen.size())))];
}

// Returns a random whole pixel in the middle part of a view.
glm::dvec2 TurnedSequence::somewhere(ViewId id, double share) {
  const glm::dvec2 size(twin_.sizes.at(id)),
      by(chance_.between(-share, share), chance_.between(-share, share));
  return glm::floor(size * (0.5 + by / 2.0));
}

bool TurnedSequence::turns() {
  struct Turn {
    Qt::Key key;
    Qt::KeyboardModifiers with;
    glm::dmat2 seen;
  };
  const Turn all[] = {{Qt::Key_R, Qt::ControlModifier, {{0, 1}, {-1, 0}}},
                      {Qt::Key_R, Qt::ControlModifier | Qt::ShiftModifier, {{0, -1}, {1, 0}}},
                      {Qt::Key_H, Qt::ControlModifier, {{-1, 0}, {0, 1}}},
                      {Qt::Key_H, Qt::ControlModifier | Qt::ShiftModifier, {{1, 0}, {0, -1}}}};
  const Turn& turn = all[chance_.below(4)];
  QTest::keyClick(view(focus_), turn.key, turn.with);
  twin_.turn(focus_, turn.seen);
  detail_ = QStringLiteral("[%1 %2]").arg(turn.seen[0].x).arg(turn.seen[0].y);
  return true;
}

bool TurnedSequence::pans() {
  const glm::dvec2 from = somewhere(focus_, 0.5), way(chance_.below(60) - 30, chance_.below(60) - 30);
  drag(view(focus_), pointAt(from), pointAt(from + way), Qt::MiddleButton);
  twin_.panBy(focus_, way);
  return true;
}

// The program chooses the zoom factor, but the position under the pointer must stay.
bool TurnedSequence::zooms() {
  const glm::dvec2 at = somewhere(focus_, 0.6);
  const double way = (chance_.oneIn(2) ? 1 : -1) * (15 + chance_.below(50));
  const double before = view(focus_)->plane()->mmPerPixel;
  drag(view(focus_), pointAt(at), pointAt(at + glm::dvec2(0, way)), Qt::RightButton);
  const double after = view(focus_)->plane()->mmPerPixel;
  if ((after > before) != (way > 0)) fault_ = QStringLiteral("zooms the wrong way");
  twin_.zoomAt(focus_, at, after);
  return true;
}

bool TurnedSequence::scrolls() {
  const int notches = chance_.below(9) - 4;
  if (notches == 0) return false;
  const int place = twin_.place(focus_).first;
  wheel(view(focus_), -notches);
  twin_.scrollTo(focus_, place + notches);
  detail_ = QStringLiteral("by %1").arg(notches);
  return true;
}

bool TurnedSequence::movesCrosshair() {
  const TwinSeen seen = twin_.seen(focus_);
  const glm::dvec2 to = somewhere(focus_, 0.5);
  const glm::dvec3 p = seen.patientAt(to);
  const VoxelGeometry& g = twin_.geometry(focus_);
  const glm::dvec3 voxel = glm::inverse(g.patientFromVoxelStep) * (p - g.origin);
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < 0 || voxel[axis] > g.size[axis] - 1) return false;
  pointWithShift(pointAt(to));
  TwinCross now = twin_.cross(focus_);
  now.at = p;
  twin_.setCross(focus_, now);
  return true;
}

// Drags the round handle of another plane's line.
bool TurnedSequence::turnsPlanes() {
  if (twin_.zoom || twin_.pan) return false;  // the documents do not say which view follows
  SliceView* const on = view(focus_);
  const SlicePress press{session(), focus_, on->shown(), *on->plane(), on->devicePixelRatioF(), {}, {}, {}};
  for (const CrossLine& line : crossLines(press))
    for (const QPointF handle : line.handles) {
      const QPointF from = handle.toPoint();
      if (twin_.views.at(focus_).over >= 0 && from.x() < 80) continue;  // the colour bar covers it
      const glm::dvec2 middle = twin_.seen(focus_).placeOf(twin_.cross(focus_).at);
      for (const DrawnMeasurement& d : on->drawnMeasurements())
        if (hitAt({d}, from)) return false;
      const QPointF to = (from + QPointF(chance_.below(60) - 30, chance_.below(60) - 30)).toPoint();
      const auto angle = [&](QPointF p) { return std::atan2(p.y() - middle.y, p.x() - middle.x); };
      if (std::hypot(to.x() - middle.x, to.y() - middle.y) < 10) return false;
      const Crosshair before = crosshairOf(workspace(), focus_, *on->shown());
      drag(on, from, to);
      if (crosshairOf(workspace(), focus_, *on->shown()) == before)
        return on->setFocus(), detail_ = QStringLiteral("not"), true;
      twin_.turnOthers(focus_, angle(to) - angle(from));
      return true;
    }
  return false;
}

bool TurnedSequence::alignsPlanes() {
  if (twin_.zoom || twin_.pan) return false;
  TwinCross now = twin_.cross(focus_);
  now.byHand.reset();
  const bool toPatient = chance_.oneIn(2);
  if (toPatient) now.byHand = alongPatient();
  child<QAction>(toPatient ? "straightenPlanes" : "alignPlanes")->trigger();
  twin_.setCross(focus_, now);
  detail_ = QLatin1String(toPatient ? "along the patient" : "along the slices");
  return true;
}

bool TurnedSequence::resetsView() {
  if (twin_.cross(focus_).byHand && (twin_.zoom || twin_.pan)) return false;
  QTest::keyClick(view(focus_), Qt::Key_F);
  twin_.reset(focus_);
  return true;
}

bool TurnedSequence::choosesLayout() {
  const char* const layouts[] = {"layoutOne", "layoutPlanes", "layoutBesidePlanes", "layoutTwo",
                                 "layoutFour"};
  const char* const chosen = layouts[chance_.below(5)];
  child<QAction>(chosen)->trigger();
  detail_ = QLatin1String(chosen);
  return true;
}

// The program chooses the point in the view's middle. The new picture is neither turned nor mirrored.
bool TurnedSequence::choosesKind() {
  if (focus_ < firstComparedId) return false;
  const char* const actions[] = {"showAxial", "showCoronal", "showSagittal"};
  TwinLook& look = twin_.views.at(focus_);
  const TwinKind kind = TwinKind(chance_.below(3));
  if (kind == look.kind) return false;
  child<QAction>(actions[kind])->trigger();
  look.kind = kind;
  look.seen = glm::dmat2(1);
  look.middle = {0, 0};
  const TwinSeen centred = twin_.seen(focus_);
  const glm::dvec3 off = view(focus_)->plane()->centre - centred.centre;
  look.middle = {glm::dot(off, centred.right), glm::dot(off, centred.down)};
  detail_ = QLatin1String(actions[kind]);
  return true;
}

bool TurnedSequence::links() {
  const char* const actions[] = {"linkScroll", "linkZoom", "linkPan"};
  const int which = chance_.below(3);
  child<QAction>(actions[which])->trigger();
  detail_ = QLatin1String(actions[which]);
  if (which == 0) return twin_.linkScroll(!twin_.scroll, focus_), true;
  bool& linked = which == 1 ? twin_.zoom : twin_.pan;
  linked = !linked;
  if (linked) twin_.follow(focus_);
  return true;
}

bool TurnedSequence::inverts() {
  QTest::keyClick(view(focus_), Qt::Key_I);
  TwinLook& look = twin_.views.at(focus_);
  look.inverted = !look.inverted;
  return true;
}

// Changes the overlay of all views that show slices together with this one.
bool TurnedSequence::overlays() {
  TwinLook& look = twin_.views.at(focus_);
  const int over = look.over < 0 ? 1 - look.series : -1;
  session().change(
      QStringLiteral("Overlay"),
      withOverlay(workspace(), focus_, over < 0 ? nullptr : &series_[std::size_t(over)]->series));
  for (auto& [id, other] : twin_.views)
    if (id == focus_ || (id < firstComparedId && focus_ < firstComparedId)) other.over = over;
  detail_ = QLatin1String(over < 0 ? "off" : "on");
  return true;
}

bool TurnedSequence::measures() {
  const glm::dvec2 from = somewhere(focus_, 0.5), to = somewhere(focus_, 0.5);
  if (glm::distance(from, to) < 40 || std::min(std::abs(from.x - to.x), std::abs(from.y - to.y)) < 8)
    return false;
  const TwinSeen seen = twin_.seen(focus_);
  const bool isLine = chance_.oneIn(2);
  const glm::dvec2 mm = glm::abs(to - from) * seen.mmPerPixel;
  const double number = isLine ? glm::length(mm) : mm.x * mm.y;
  return RandomWalk::measures(
      view(focus_), isLine ? "lengthTool" : "rectangleTool", pointAt(from), pointAt(to), number,
      0.05 + 0.006 * number, [&](int id, const QString& said) {
        twin_.shapes.push_back({id, isLine, seen.patientAt(from), seen.patientAt(to), said});
      });
}

bool TurnedSequence::resizes() {
  window.resize(900 + chance_.below(300), 640 + chance_.below(200));
  return true;
}

}  // namespace volumen::tests
