#pragma once

#include <QWheelEvent>

#include "tests/ui/measure_window.h"
#include "ui/tools/mouse_bindings.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// The state that a gesture can change in the axial view.
struct FlatSeen {
  std::optional<Window> window;
  FlatLook look;
  glm::dvec3 at{0};

  explicit FlatSeen(MeasureWindow& w) {
    const ViewState& state = w.view()->state();
    window = w.session().workspace().series.at(state.series).window;
    look = flatLookOf(state);
    at = crosshairOf(w.session().workspace(), axialViewId, *w.view()->shown()).at;
  }
};

/// Returns the names of the actions done between two states. The voxels are 1 mm.
inline std::string doneBetween(const FlatSeen& before, const FlatSeen& after) {
  std::string done;
  if (before.look.slabMm != after.look.slabMm) done += "slab ";
  if (before.look.zoom != after.look.zoom)
    done += "zoom ";
  else if (before.look.panMm != after.look.panMm)
    done += "pan ";
  if (before.window != after.window) done += "window ";
  const glm::dvec3 moved = after.at - before.at;
  if (moved.x != 0 || moved.y != 0)
    done += "crosshair ";
  else if (std::abs(moved.z) > 9.5)
    done += "fast ";
  else if (moved.z != 0)
    done += "scroll ";
  return done.empty() ? "none" : done.substr(0, done.size() - 1);
}

/// Scrolls with two fingers on a trackpad.
inline void slide(QWidget* on, QPoint pixels, Qt::KeyboardModifiers keys) {
  const QPointF middle(on->width() / 2.0, on->height() / 2.0);
  QWheelEvent event(middle, on->mapToGlobal(middle), pixels, pixels * 4, Qt::NoButton, keys,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(on, &event);
}

/// Adds a row for each mouse preset.
inline void addMousePresets() {
  QTest::addColumn<QByteArray>("preset");
  for (const MousePreset& preset : mousePresets())
    QTest::newRow(preset.name.c_str()) << QByteArray(preset.name.c_str());
}

inline void chooseMousePreset(Session& session, const QByteArray& preset) {
  session.prefer(withMousePreset(session.preferences(), preset.toStdString()));
}

}  // namespace volumen::tests
