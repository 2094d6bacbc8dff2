#pragma once

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// Slices along z as of DICOM files, each of its own values; the last one is the uppermost.
inline LoadedSeriesPtr stackSeries(int slices) {
  auto series = std::make_shared<LoadedSeries>(*seriesOf(volumeOf<std::int16_t>(
      {24, 22, slices}, glm::dmat3(1), [](glm::dvec3 p) { return 10 * p.z + 3 * p.x + p.y; })));
  series->series.acquired = series->volume->geometry();
  for (int n = 0; n < slices; ++n) {
    series->series.files.push_back(std::to_string(n) + ".dcm");
    series->series.frames.push_back(0);
    series->series.sopInstanceUids.push_back("1.2." + std::to_string(n));
  }
  return series;
}

/// A window that shows such a stack.
struct StackWindow : MeasureWindow {
  explicit StackWindow(int slices = 31) : MeasureWindow(stackSeries(slices)) {}

  /// Where the crosshair is in the stack of a view, from its first end.
  int place(ViewId id = axialViewId) {
    const LoadedSeriesPtr shown = view(id)->shown();
    return stackPlace(shown->volume->geometry(), view(id)->state().kind,
                      crosshairOf(session().workspace(), id, *shown))
        .index;
  }
  int steps() { return session().undoStack().index(); }
  /// The one of this name that is on screen; null: none is.
  template <class Widget>
  Widget* seen(const char* name, ViewId id = axialViewId) {
    for (auto* widget : view(id)->findChildren<Widget*>(QLatin1String(name)))
      if (widget->isVisible()) return widget;
    return nullptr;
  }
  /// Types in place of what stands there, and Enter.
  static void type(QLineEdit* field, const QString& text) {
    field->setFocus();
    field->selectAll();
    QTest::keyClick(field, Qt::Key_Delete);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
};

}  // namespace volumen::tests
