#pragma once

#include <QAction>
#include <vector>

#include "tests/ui/stack_window.h"
#include "ui/views/cine_bar.h"

namespace volumen::tests {

/// A stack in one view, and the cine bar that plays it.
struct CineWindow : StackWindow {
  CineWindow() {
    window.resize(1440, 900);
    child<QAction>("layoutOne")->trigger();
    QCoreApplication::processEvents();
  }
  CineBar* bar() { return view()->findChild<CineBar*>(); }
  // Rests the pointer at the bottom of the view.
  bool showBar() {
    hover(view(), {60.0, view()->height() - 2.0});
    return QTest::qWaitFor([&] { return bar()->isVisible(); }, longest);
  }
  // Returns the slice positions of the next `count` steps while it plays.
  std::vector<int> played(int count) {
    std::vector<int> places{place()};
    const auto listening = QObject::connect(&session(), &Session::workspaceChanged, &window, [&] {
      if (place() != places.back()) places.push_back(place());
    });
    const bool came = QTest::qWaitFor([&] { return int(places.size()) > count; }, longest);
    QObject::disconnect(listening);
    return came ? places : std::vector<int>{};
  }
};

}  // namespace volumen::tests
