#include <QMenu>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "tests/ui/gestures.h"
#include "tests/ui/known_steps.h"
#include "tests/ui/turned_focus.h"
#include "tests/ui/turned_frames.h"
#include "ui/views/drawn_measurement.h"

namespace volumen::tests {

namespace {

QPointF dotAt(glm::dvec2 place) { return {place.x, place.y}; }

}  // namespace

void TurnedFrames::remember() {
  const int step = session().undoStack().index();
  known_.erase(known_.lower_bound(step), known_.end());
  known_[step] = {looks_, lines_, workspace()};
}

void TurnedFrames::take(int step) {
  looks_ = known_.at(step).looks;
  lines_ = known_.at(step).lines;
  look();
}

QString TurnedFrames::act() {
  static const std::vector<Act> acts{{"hang", 3, &TurnedFrames::hangs},
                                     {"turn", 6, &TurnedFrames::turns},
                                     {"pan", 3, &TurnedFrames::pans},
                                     {"zoom", 3, &TurnedFrames::zooms},
                                     {"scroll", 3, &TurnedFrames::scrolls},
                                     {"presentation", 5, &TurnedFrames::presents},
                                     {"invert", 1, &TurnedFrames::inverts},
                                     {"reset view", 2, &TurnedFrames::resets},
                                     {"own pixels", 1, &TurnedFrames::showsOwnPixels},
                                     {"measure", 3, &TurnedFrames::measures},
                                     {"play", 2, &TurnedFrames::plays},
                                     {"number", 1, &TurnedFrames::typesNumber},
                                     {"link", 1, &TurnedFrames::links},
                                     {"keys", 2, &TurnedFrames::movesFocus},
                                     {"save session", 1, &TurnedFrames::savesSession},
                                     {"open session", 2, &TurnedFrames::opensSession},
                                     {"resize", 2, &TurnedFrames::resizes},
                                     {"undo", 4, &TurnedFrames::undoes},
                                     {"redo", 2, &TurnedFrames::redoes}};
  int all = 0;
  for (const Act& a : acts) all += a.often;
  int chosen = chance_.below(all);
  const Act* act = acts.data();
  for (; chosen >= act->often; ++act) chosen -= act->often;
  look();
  focus_ = onScreen_[std::size_t(chance_.below(int(onScreen_.size())))];
  session().setFocus(focus_);
  session().endGesture();
  detail_.clear();
  const int before = session().undoStack().index();
  if (!(this->*act->act)()) return {};
  session().endGesture();
  if (const auto touched = looks_.find(focus_); touched != looks_.end() && isAsFaced(touched->second))
    touched->second.isFacing = true;
  look();
  if (act->act == &TurnedFrames::hangs) wrong();  // waits for its frames
  const bool isStep = act->act != &TurnedFrames::undoes && act->act != &TurnedFrames::redoes;
  if (isStep && session().undoStack().index() != before) remember();
  return QStringLiteral("%1 in view %2 %3").arg(QLatin1String(act->name)).arg(focus_).arg(detail_).trimmed();
}

// Returns the look of the view in focus, which is the reader's own from now on.
TwinFrameLook& TurnedFrames::touched() {
  seen(focus_);
  TwinFrameLook& look = looks_.at(focus_);
  look.isFacing = false;
  return look;
}

// Returns whether a view lies as it was hung. It then faces the others again, at any size.
bool TurnedFrames::isAsFaced(const TwinFrameLook& look) const {
  const auto known = faced_.find({onScreen_.size(), focus_, look.picture});
  return known != faced_.end() && look.state < 0 &&
         std::ranges::any_of(known->second, [&](const TwinFrameLook& left) {
           return left.seen == look.seen && glm::distance(left.middle, look.middle) < 1e-9 &&
                  std::abs(left.zoom - look.zoom) < 1e-9;
         });
}

bool TurnedFrames::hangs() {
  if (isClip_) return false;
  const bool next = chance_.oneIn(2);
  const int before = session().undoStack().index();
  QTest::keyClick(view(focus_), next ? Qt::Key_PageDown : Qt::Key_PageUp, Qt::AltModifier);
  look();
  if (session().undoStack().index() == before) return false;
  takeHung();
  detail_ = next ? QStringLiteral("next") : QStringLiteral("previous");
  return true;
}

bool TurnedFrames::turns() {
  const glm::dmat2 by[] = {{{0, 1}, {-1, 0}}, {{0, -1}, {1, 0}}, {{-1, 0}, {0, 1}}, {{1, 0}, {0, -1}}};
  const int which = chance_.below(4);
  TwinFrameLook& look = touched();
  QTest::keyClick(
      &window, which < 2 ? Qt::Key_R : Qt::Key_H,
      which % 2 ? Qt::ControlModifier | Qt::ShiftModifier : Qt::KeyboardModifiers(Qt::ControlModifier));
  look.seen = by[which] * look.seen;
  detail_ = QString::number(which);
  return true;
}

bool TurnedFrames::pans() {
  const glm::dvec2 way(chance_.below(60) - 30, chance_.below(60) - 30);
  if (way == glm::dvec2(0)) return false;
  const double mm = seen(focus_).mmPerPixel;
  TwinFrameLook& look = touched();
  const glm::dvec2 from = glm::floor(sizes_.at(focus_) / 2.0);
  drag(view(focus_), dotAt(from), dotAt(from + way), Qt::MiddleButton);
  look.middle -= glm::transpose(look.seen) * way * mm;
  return true;
}

bool TurnedFrames::zooms() {
  const Seen s = seen(focus_);
  TwinFrameLook& look = touched();
  const glm::dvec2 size = sizes_.at(focus_);
  const glm::dvec2 at = glm::floor(size * glm::dvec2(chance_.between(0.3, 0.7), chance_.between(0.3, 0.7)));
  const double way = (chance_.oneIn(2) ? 1 : -1) * (15 + chance_.below(40));
  drag(view(focus_), dotAt(at), dotAt(at + glm::dvec2(0, way)), Qt::RightButton);
  const double after = view(focus_)->plane()->mmPerPixel;  // the program chooses the factor
  if ((after > s.mmPerPixel) != (way > 0)) fault_ = QStringLiteral("zooms the wrong way");
  look.middle += glm::transpose(look.seen) * (at - size / 2.0) * (s.mmPerPixel - after);
  look.zoom *= s.mmPerPixel / after;
  return true;
}

// Scrolls through the pictures of the stack. A presentation state applies only to its own picture.
bool TurnedFrames::scrolls() {
  if (!isStack_) return false;
  TwinFrameLook& look = looks_.at(focus_);
  if (look.state >= 0) return false;
  const int notches = chance_.oneIn(2) ? 1 : -1, to = std::clamp(look.picture + notches, 0, 3);
  if (to == look.picture) return false;
  touched();
  wheel(view(focus_), -notches);
  look.picture = to;
  detail_ = QStringLiteral("to %1").arg(to);
  return true;
}

// Chooses a presentation state in the menu. It replaces everything done before.
bool TurnedFrames::presents() {
  if (isClip_) return false;
  TwinFrameLook& look = looks_.at(focus_);
  const int state = chance_.below(3) - 1;
  QTest::mouseClick(view(focus_), Qt::RightButton, {}, view(focus_)->rect().center());
  QMenu* menu = nullptr;
  const auto isOpen = [&] {
    for (QMenu* m : window.findChildren<QMenu*>(QStringLiteral("flatMenu")))
      if (m->isVisible()) menu = m;
    return menu != nullptr;
  };
  if (!QTest::qWaitFor(isOpen, 3000)) return fault_ = QStringLiteral("no menu"), true;
  QAction* chosen = nullptr;
  if (auto* choices = menu->findChild<QMenu*>(QStringLiteral("presentationMenu")))
    for (QAction* action : choices->actions())
      if (action->text().startsWith(state < 0 ? QStringLiteral("None")
                                              : QStringLiteral("STATE%1").arg(state)))
        chosen = action;
  if (chosen) chosen->trigger();
  menu->close();
  takeKeysBack(*this);
  if (!chosen) return fault_ = QStringLiteral("the state is not in the menu"), true;
  detail_ = QString::number(state);
  if (look.state == state) return true;
  look = {.picture = look.picture, .state = state};
  return true;
}

bool TurnedFrames::inverts() {
  TwinFrameLook& look = looks_.at(focus_);
  QTest::keyClick(view(focus_), Qt::Key_I);
  look.inverted = !look.inverted;
  return true;
}

bool TurnedFrames::resets() {
  TwinFrameLook& look = touched();
  QTest::keyClick(view(focus_), Qt::Key_F);
  look.seen = glm::dmat2(1), look.middle = {0, 0}, look.zoom = 1;
  return true;
}

bool TurnedFrames::showsOwnPixels() {
  const double before = seen(focus_).mmPerPixel;
  TwinFrameLook& look = touched();
  QTest::keyClick(view(focus_), Qt::Key_O);
  const glm::dvec2 spacing = pictures_[std::size_t(look.picture)].spacing;
  look.zoom *= before / std::min(spacing.x, spacing.y);
  return true;
}

bool TurnedFrames::measures() {
  FrameView* const on = view(focus_);
  const Seen s = seen(focus_);
  const glm::dvec2 size = sizes_.at(focus_);
  const auto somewhere = [&] {
    return glm::floor(size * glm::dvec2(chance_.between(0.3, 0.7), chance_.between(0.3, 0.7)));
  };
  const glm::dvec2 from = somewhere(), to = somewhere();
  if (glm::distance(from, to) < 30 || lines_.size() > 4) return false;
  for (const DrawnMeasurement& d : on->drawnMeasurements())
    if (hitAt({d}, dotAt(from))) return false;
  const std::size_t before = workspace().measurements.size();
  child<QAction>("lengthTool")->trigger();
  drag(on, dotAt(from), dotAt(to));
  if (workspace().measurements.size() != before + 1) return fault_ = QStringLiteral("nothing is drawn"), true;
  TwinLine line{
      workspace().measurements.back().id, looks_.at(focus_).picture, s.pixelAt(from), s.pixelAt(to), {}};
  const auto said = [&] {
    for (const DrawnMeasurement& d : on->drawnMeasurements())
      if (d.id == line.id) line.said = d.text.value(0);
    return !line.said.isEmpty();
  };
  if (!QTest::qWaitFor(said, 3000)) fault_ = QStringLiteral("no number");
  const double mm = glm::length((line.to - line.from) * s.spacing);
  const double is = QRegularExpression(QStringLiteral("[\\d.]+")).match(line.said).captured().toDouble();
  if (std::abs(is - mm) > 0.005 + 0.006 * mm)
    fault_ = QStringLiteral("says %1 instead of %2").arg(line.said).arg(mm);
  lines_.push_back(line);
  return true;
}

bool TurnedFrames::resizes() {
  window.resize(1000 + chance_.below(300), 640 + chance_.below(200));
  return true;
}

bool TurnedFrames::undoes() {
  return undoneTo(*this, first_, known_, [this](int step) { take(step); });
}

bool TurnedFrames::redoes() {
  return doneAgain(*this, known_, [this](int step) { take(step); });
}

// Facing views follow the size of the window, so only the appearance of positions must be restored.
QString TurnedFrames::wrongUndone() {
  const int last = session().undoStack().index();
  for (const int to : {first_, last}) {
    goToStep(*this, to);
    take(to);
    if (const QString why = wrong(); !why.isEmpty()) return why;
  }
  return {};
}

}  // namespace volumen::tests
