#pragma once

#include <QAction>
#include <QTest>
#include <glm/geometric.hpp>
#include <vector>

#include "io/curved.h"
#include "results/series/series_facts.h"
#include "tests/ui/gestures.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/session_folder.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// Short names for tests of curved planes.
namespace curved {

/// The views of the curve's layout.
inline constexpr ViewId slices = firstComparedId, straightened = slices + 1, stretched = slices + 2,
                        sections = slices + 3;

/// An arch around the spine, from the patient's right to the left, within the trunk of the CT.
inline const std::vector<glm::dvec3> arch{{-24, 0, 0}, {-16, -14, 0}, {0, -18, 0}, {16, -14, 0}, {24, 0, 0}};

}  // namespace curved

/// A window that shows a CT with voxels of 2 mm in planes.
struct CurveWindow : Journey {
  explicit CurveWindow(const SessionFolder& folder) : Journey({folder.ct()}) {
    if (!settle()) return;
    child<QAction>("layoutPlanes")->trigger();
    session().setFocus(axialViewId);
    QCoreApplication::processEvents();
  }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FlatView* view(ViewId id) { return window.views()->viewAs<FlatView>(id); }
  void press(const char* action) { child<QAction>(action)->trigger(); }

  QPointF pixel(ViewId id, glm::dvec3 p) {
    const glm::dvec2 at = view(id)->plane()->pixelFromPatient(p) / view(id)->devicePixelRatioF();
    return {at.x, at.y};
  }
  void click(ViewId id, glm::dvec3 p) {
    QTest::mouseClick(view(id), Qt::LeftButton, {}, pixel(id, p).toPoint());
  }

  /// Draws a curve by clicks in an axial slice, and Enter.
  void drawCurve(const std::vector<glm::dvec3>& points, ViewId id = axialViewId) {
    press("openCurveTool");
    for (const glm::dvec3 p : points) click(id, p);
    QTest::keyClick(view(id), Qt::Key_Return);
  }
  const Measurement& curve() { return workspace().measurements.back(); }

  const Series& seriesAt(ViewId id) { return *seriesIn(workspace(), id); }
  LoadedSeriesPtr loaded(ViewId id) { return session().seriesOf(id); }
  /// Returns true once all four views have their volume.
  bool showCurve(const char* action = "showCurvedPlane") {
    press(action);
    return QTest::qWaitFor([&] { return isShown(); }, longest);
  }
  bool isShown() {
    return loaded(curved::slices) && loaded(curved::straightened) && loaded(curved::stretched) &&
           loaded(curved::sections) && !window.document().loader.isBusy();
  }
  /// Returns the crosshair as Session does, even if nobody has set it yet.
  Crosshair crosshair(ViewId id) { return crosshairOf(workspace(), id, *loaded(id)); }
  CurvedGrid grid(ViewId id) {
    const Series& series = seriesAt(id);
    return *CurvedGrid::make(series.curved->recipe, drawnGeometry(sourceOf(series)));
  }
};

}  // namespace volumen::tests
