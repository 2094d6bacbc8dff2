#pragma once

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// Returns slices along z, as from DICOM files, each with its own values. The last is the uppermost.
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

/// A window that shows a stack of stackSeries().
struct StackWindow : MeasureWindow {
  explicit StackWindow(int slices = 31) : MeasureWindow(stackSeries(slices)) {}

  /// Returns the index of the crosshair in the stack of a view.
  int place(ViewId id = axialViewId) {
    const LoadedSeriesPtr shown = view(id)->shown();
    return stackPlace(shown->volume->geometry(), view(id)->state().kind,
                      crosshairOf(session().workspace(), id, *shown))
        .index;
  }
  int steps() { return session().undoStack().index(); }
  /// Returns the widget of this name that is on screen; null if there is none.
  template <class Widget>
  Widget* seen(const char* name, ViewId id = axialViewId) {
    for (auto* widget : view(id)->findChildren<Widget*>(QLatin1String(name)))
      if (widget->isVisible()) return widget;
    return nullptr;
  }
  /// Replaces the text of a field and presses Enter.
  static void type(QLineEdit* field, const QString& text) {
    field->setFocus();
    field->selectAll();
    QTest::keyClick(field, Qt::Key_Delete);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
};

}  // namespace volumen::tests
