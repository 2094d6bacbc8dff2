#include <QMenu>

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/curved_planes.h"

namespace volumen {

namespace {

constexpr double usualWidth = 50;  // mm

// Shows the straightened plane, the stretched plane and cross-sections of a drawn curve beside its slices.
class CurvedPlanes : public Feature {
 public:
  explicit CurvedPlanes(Workbench& bench);

 private:
  void show(double halfWidth);
  glm::dvec3 towards(const Measurement& curve) const;
};

CurvedPlanes::CurvedPlanes(Workbench& bench) : Feature(bench) {
  const auto add = [this](const char* name, const QString& text, double mm, const Place& place) {
    return bench_.addAction({name, text, {}, "", false, [this, mm](bool) { show(mm / 2); }, {place}});
  };
  QAction* usual = add("showCurvedPlane", tr("Show curved plane"), usualWidth, {"measureMenu", 90, 10});
  bench_.addMenu("curvedMenu", tr("Curved plane of another width"), {{"measureMenu", 90, 20}});
  add("showCurvedPlane20", tr("Curved plane 20 mm wide"), 20, {"curvedMenu", 10});
  add("showCurvedPlane100", tr("Curved plane 100 mm wide"), 100, {"curvedMenu", 10, 10});
  connect(&bench_, &Workbench::sliceMenuOpens, this, [this, usual](QMenu* menu) {
    if (curveMeant(session_.workspace())) menu->addAction(usual);
  });
}

void CurvedPlanes::show(double halfWidth) {
  const Measurement* curve = curveMeant(session_.workspace());
  if (!curve) return warn(tr("Draw a curve first: choose Measure > Curve and click its points in slices."));
  const Result<CurvedPair> pair = curvedPair(session_.workspace(), *curve, towards(*curve), halfWidth);
  if (!pair) return warn(QString::fromStdString(pair.message()));
  session_.endGesture();
  session_.setFocus(mainFocusOf(session_.workspace()));
  grid_.setAlone(sceneViewId, false);
  session_.change(tr("Show curved plane"), withCurvedPlanes(session_.workspace(), *pair));
  session_.endGesture();
}

// Returns the normal of the focused slice view if it shows the curve's series, else a default.
glm::dvec3 CurvedPlanes::towards(const Measurement& curve) const {
  const FlatView* view = bench_.flatViewInFocus();
  const bool isOfIt = view && view->shown() && keyOf(view->shown()->series) == curve.series;
  const std::optional<SlicePlane> plane = isOfIt ? view->plane() : std::nullopt;
  return plane ? plane->normal() : usualTowards(session_.workspace(), curve);
}

}  // namespace

std::unique_ptr<Feature> makeCurvedPlanes(Workbench& bench) { return std::make_unique<CurvedPlanes>(bench); }

}  // namespace volumen
