#pragma once

#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// The phantom that SegmentsWindow opens.
inline const QString spherePhantom = QStringLiteral("phantom:sphere:64");

/// A window that shows a sphere, and presses buttons in the Segments panel.
struct SegmentsWindow : Journey {
  explicit SegmentsWindow(const QStringList& paths = {spherePhantom}) : Journey(paths) { settle(); }

  QString result() { return child<QLabel>("segmentResult")->text(); }
  bool segment(double low, double high, const char* button = "segment") {
    child<QDockWidget>("segmentDock")->raise();
    child<QDoubleSpinBox>("segmentLow")->setValue(low);
    child<QDoubleSpinBox>("segmentHigh")->setValue(high);
    const QString before = result();
    QTest::mouseClick(child<QPushButton>(button), Qt::LeftButton);
    return QTest::qWaitFor([&] { return result().contains(QStringLiteral("voxels")) && result() != before; },
                           longest);
  }
  const Workspace& workspace() { return window.session().workspace(); }
  const SegmentMap& map() { return workspace().segmentMaps.front(); }
  void undo() { child<QAction>("undo")->trigger(); }
  QUndoStack& undoStack() { return window.session().undoStack(); }
};

}  // namespace volumen::tests
