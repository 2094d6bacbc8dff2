#pragma once

#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"

namespace volumen::tests {

inline constexpr ViewId besideFirst = firstSecondId, besideSecond = firstSecondId + 1;

inline WindowBeside& secondWindowOf(Journey& w) { return w.window.views()->secondWindow(); }

/// Opens the second window as a reader does; it has the keys then.
inline bool opensSecondWindow(Journey& w) {
  QCoreApplication::processEvents();
  QTest::keyClick(&w.window, Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  return QTest::qWaitFor([&] { return secondWindowOf(w).isVisible() && secondWindowOf(w).isActiveWindow(); },
                         longest);
}

/// Planes of a series in the main window, another one of the same frame of reference in the second.
struct Beside : MeasureWindow {
  const LoadedSeriesPtr series = ballIn("A");
  const bool isOpen = opensSecondWindow(*this);

  Beside() : MeasureWindow(ballIn("A")) { session().show(series, besideFirst); }

  const Workspace& workspace() { return session().workspace(); }
  ViewGrid& views() { return *window.views(); }
  WindowBeside& beside() { return secondWindowOf(*this); }
  double z(ViewId id) { return view(id)->plane()->centre.z; }
  /// A key for what has the keys in the second window.
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(beside().focusWidget(), key, keys);
  }
  /// A click in a view, which brings its window to the front.
  bool click(ViewId id) {
    QTest::mouseClick(views().viewOf(id), Qt::LeftButton, {}, {5, 5});
    QWidget* clicked = views().viewOf(id)->window();
    return QTest::qWaitFor([&] { return clicked->isActiveWindow() && workspace().focus == id; }, longest);
  }
  /// As by a press on its frame, or by the system's own keys.
  bool activate(QWidget& one) {
    one.activateWindow();
    return QTest::qWaitFor([&] { return one.isActiveWindow(); }, longest);
  }
  bool isInverted(ViewId id) { return flatLookOf(workspace().view(id)).inverted; }
  bool isSeen(ViewId id) { return views().viewOf(id)->isVisible(); }
};

}  // namespace volumen::tests
