#include <QMenu>
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "tests/ui/turned_frames.h"

namespace volumen::tests {

namespace {

QPointF dotAt(glm::dvec2 place) { return {place.x, place.y}; }

}  // namespace

void TurnedFrames::take(const FramesTwin& twin) {
  twin_ = twin;
  look();
}

auto TurnedFrames::acts() -> const std::vector<Act>& {
  static const std::vector<Act> all{{"hang", 3, &TurnedFrames::hangs},
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
  return all;
}

ViewId TurnedFrames::anyView() {
  look();
  return onScreen_[std::size_t(chance_.below(int(onScreen_.size())))];
}

void TurnedFrames::afterAct() {
  if (const auto touched = twin_.looks.find(focus_);
      touched != twin_.looks.end() && isAsFaced(touched->second))
    touched->second.isFacing = true;
  look();
}

// Returns the look of the view in focus, which is the reader's own from now on.
TwinFrameLook& TurnedFrames::touched() {
  seen(focus_);
  TwinFrameLook& look = twin_.looks.at(focus_);
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
  wrong();  // waits for its frames
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
  TwinFrameLook& look = twin_.looks.at(focus_);
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
  TwinFrameLook& look = twin_.looks.at(focus_);
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
  TwinFrameLook& look = twin_.looks.at(focus_);
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
  const Seen s = seen(focus_);
  const glm::dvec2 size = sizes_.at(focus_);
  const auto somewhere = [&] {
    return glm::floor(size * glm::dvec2(chance_.between(0.3, 0.7), chance_.between(0.3, 0.7)));
  };
  const glm::dvec2 from = somewhere(), to = somewhere();
  if (glm::distance(from, to) < 30 || twin_.lines.size() > 4) return false;
  TwinLine line{0, twin_.looks.at(focus_).picture, s.pixelAt(from), s.pixelAt(to), {}};
  const double mm = glm::length((line.to - line.from) * s.spacing);
  return RandomWalk::measures(view(focus_), "lengthTool", dotAt(from), dotAt(to), mm, 0.005 + 0.006 * mm,
                              [&](int id, const QString& said) {
                                line.id = id, line.said = said;
                                twin_.lines.push_back(line);
                              });
}

bool TurnedFrames::resizes() {
  window.resize(1000 + chance_.below(300), 640 + chance_.below(200));
  return true;
}

}  // namespace volumen::tests
