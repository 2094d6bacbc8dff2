#include <algorithm>

#include "tests/ui/turned_frames.h"

namespace volumen::tests {

// Plays the pictures of a series. The clock decides how far it gets before C is pressed again.
bool TurnedFrames::plays() {
  const TwinFrameLook& look = twin_.looks.at(focus_);
  if (!isStack_ || look.state >= 0) return false;
  FrameView* const on = view(focus_);
  const auto onScreen = [&] { return on->frame() ? on->frame()->key.index : -1; };
  const int before = look.picture, steps = session().undoStack().index();
  QTest::keyClick(on, Qt::Key_C);
  if (!on->isPlaying()) return fault_ = QStringLiteral("C does not play"), true;
  if (!QTest::qWaitFor([&] { return onScreen() != before; }, 5000))
    fault_ = QStringLiteral("nothing is played");
  QTest::keyClick(on, Qt::Key_C);
  const int now = flatLookOf(workspace().view(focus_)).frame;
  if (on->isPlaying()) fault_ = QStringLiteral("C does not stop");
  if (now != onScreen()) fault_ = QStringLiteral("it stops at another frame than is seen");
  if (session().undoStack().index() != steps + 1) fault_ = QStringLiteral("what is played is no single step");
  touched().picture = now;
  detail_ = QStringLiteral("from %1 to %2").arg(before).arg(now);
  return true;
}

// A presentation state applies only to its own picture.
bool TurnedFrames::typesNumber() {
  if (!isStack_) return false;
  const int number = 1 + chance_.below(4);
  const bool isMeant = twin_.looks.at(focus_).state < 0 && !chance_.oneIn(3);
  if (const QString why = wrongAfterNumber(*this, number, isMeant); !why.isEmpty()) fault_ = why;
  if (isMeant && twin_.looks.at(focus_).picture != number - 1) touched().picture = number - 1;
  detail_ = isMeant ? QString::number(number) : QStringLiteral("%1, given up").arg(number);
  return true;
}

// Frames without a position in the patient follow nothing and cannot be locked.
bool TurnedFrames::links() {
  const char* const actions[] = {"linkScroll", "linkZoom", "linkPan", "lockHere"};
  const int which = chance_.below(4);
  auto* action = child<QAction>(actions[which]);
  if (which == 3 && action->isEnabled()) fault_ = QStringLiteral("frames can be locked");
  action->trigger();
  detail_ = QLatin1String(actions[which]);
  return true;
}

// Facing views change their size while one is maximised.
bool TurnedFrames::movesFocus() {
  return RandomWalk::movesFocus([this] {
    sizes_[focus_] = {view(focus_)->pixels().width(), view(focus_)->pixels().height()};
    return twin_.looks.at(focus_).isFacing ? QString() : wrongIn(focus_);
  });
}

bool TurnedFrames::savesSession() {
  const QString name = QStringLiteral("saved%1.volumen").arg(++savedTimes_);
  child<QAction>("saveSessionAs")->trigger();
  answer(*this, "saveSessionDialog", sessions_.filePath(name));
  if (!QTest::qWaitFor([&] { return window.windowTitle().contains(name); }, longest))
    fault_ = QStringLiteral("the session is not saved");
  takeKeysBack(*this);
  saved_ = {twin_, workspace()};
  detail_ = name;
  return true;
}

// Restores the saved state. It is an undo step if anything has changed since.
bool TurnedFrames::opensSession() {
  if (!saved_ || RandomWalk::comparable(workspace()) == RandomWalk::comparable(saved_->second)) return false;
  const QString name = QStringLiteral("saved%1.volumen").arg(savedTimes_);
  const int before = session().undoStack().index();
  child<QAction>("openSession")->trigger();
  answer(*this, "openSessionDialog", sessions_.filePath(name));
  if (!QTest::qWaitFor([&] { return session().undoStack().index() > before; }, longest))
    fault_ = QStringLiteral("the session is not opened");
  takeKeysBack(*this);
  saved_->second = workspace();
  take(saved_->first);
  wrong();  // waits for its frames
  detail_ = name;
  return true;
}

}  // namespace volumen::tests
