#pragma once

#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"

namespace volumen::tests {

inline constexpr ViewId besideFirst = firstSecondId, besideSecond = firstSecondId + 1;

inline WindowBeside& secondWindowOf(Journey& w) { return w.window.views()->secondWindow(); }

/// Opens the second window as a reader does. It then has the keyboard focus.
inline bool opensSecondWindow(Journey& w) {
  QCoreApplication::processEvents();
  QTest::keyClick(&w.window, Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  return QTest::qWaitFor([&] { return secondWindowOf(w).isVisible() && secondWindowOf(w).isActiveWindow(); },
                         longest);
}

/// Planes of a series in the main window, and another series of the same frame of reference in the second.
struct Beside : MeasureWindow {
  const LoadedSeriesPtr series = ballIn("A");
  const bool isOpen = opensSecondWindow(*this);

  Beside() : MeasureWindow(ballIn("A")) { session().show(series, besideFirst); }

  const Workspace& workspace() { return session().workspace(); }
  ViewGrid& views() { return *window.views(); }
  WindowBeside& beside() { return secondWindowOf(*this); }
  double z(ViewId id) { return view(id)->plane()->centre.z; }
  /// Presses a key in the widget that has the focus in the second window.
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(beside().focusWidget(), key, keys);
  }
  /// Clicks in a view, which brings its window to the front.
  bool click(ViewId id) {
    QTest::mouseClick(views().viewOf(id), Qt::LeftButton, {}, {5, 5});
    QWidget* clicked = views().viewOf(id)->window();
    return QTest::qWaitFor([&] { return clicked->isActiveWindow() && workspace().focus == id; }, longest);
  }
  /// Activates a window, as a press on its title bar or the system's shortcuts do.
  bool activate(QWidget& one) {
    one.activateWindow();
    return QTest::qWaitFor([&] { return one.isActiveWindow(); }, longest);
  }
  bool isInverted(ViewId id) { return flatLookOf(workspace().view(id)).inverted; }
  bool isSeen(ViewId id) { return views().viewOf(id)->isVisible(); }
};

}  // namespace volumen::tests
