#pragma once

#include <QTextDocumentFragment>
#include <QToolButton>
#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

inline constexpr ViewId left = firstComparedId, right = firstComparedId + 1;

/// Returns a ball in a frame of reference of its own.
inline LoadedSeriesPtr ballIn(const char* frame, double spacing = 1, const char* modality = "CT") {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(32, 10, {0, 0, 0}, glm::dvec3(spacing)));
  series->series.acquired = series->volume->geometry();
  series->series.frameOfReferenceUid = frame;
  series->series.modality = modality;
  series->window = {500, 1000};
  return series;
}

/// Returns a PET of 1000 Bq/ml in a ball, which are 5 SUVbw.
inline LoadedSeriesPtr petIn(const char* frame) {
  auto series = std::make_shared<LoadedSeries>(*ballIn(frame, 1, "PT"));
  series->series.description = "Uptake";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = 0.005;
  return series;
}

/// Returns three balls of different size that no turn maps onto each other, all moved.
inline LoadedSeriesPtr lumpsIn(const char* frame, glm::dvec3 moved) {
  constexpr int n = 40;
  VolumeParts parts;
  parts.geometry.size = glm::ivec3(n);
  parts.geometry.patientFromVoxelStep *= 3.0;
  parts.geometry.origin = glm::dvec3(-1.5 * (n - 1));
  std::vector<std::int16_t> values;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const glm::dvec3 p = parts.geometry.patientFromVoxel({i, j, k}) - moved;
        const auto near = [&](glm::dvec3 centre, double mm) {
          return std::clamp((mm - glm::length(p - centre)) / 3 + 0.5, 0.0, 1.0);
        };
        values.push_back(std::int16_t(1000 * near({-15, 5, 0}, 20) + 600 * near({20, 12, 8}, 12) +
                                      800 * near({4, -18, 20}, 9)));
      }
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  auto series = std::make_shared<LoadedSeries>(*ballIn(frame));
  series->volume = *Volume::make(std::move(parts), warnings);
  series->series.acquired = series->volume->geometry();
  return series;
}

/// Shows two series side by side.
struct TwoSeries : Journey {
  TwoSeries(const LoadedSeriesPtr& a, const LoadedSeriesPtr& b) {
    session().show(a);
    child<QAction>("layoutTwo")->trigger();
    session().show(a, left);
    session().show(b, right);
    session().setFocus(left);
    QCoreApplication::processEvents();
  }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FlatView* view(ViewId id) { return window.views()->viewAs<FlatView>(id); }
  SlicePlane plane(ViewId id) { return *view(id)->plane(); }
  double z(ViewId id) { return plane(id).centre.z; }
  void press(const char* action) { child<QAction>(action)->trigger(); }
  void scroll(ViewId id, int notches) {
    const QPointF at = view(id)->rect().center();
    QWheelEvent wheel(at, view(id)->mapToGlobal(at), {}, {0, -120 * notches}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(view(id), &wheel);
    session().endGesture();
  }
  void zoom(ViewId id) { drag(view(id), {100, 200}, {100, 150}, Qt::RightButton); }
  void pan(ViewId id) { drag(view(id), {100, 100}, {120, 130}, Qt::MiddleButton); }
  QString corner(ViewId id) { return view(id)->overlays().topRight.join(QLatin1Char('\n')); }
  QString tip() {
    return QTextDocumentFragment::fromHtml(child<QToolButton>("linkButton")->toolTip()).toPlainText();
  }
};

}  // namespace volumen::tests
