#include <QDockWidget>

#include "ui/features/feature.h"
#include "ui/panels/chart_panel.h"

namespace volumen {

namespace {

// Shows charts of the values under measurements.
class ChartsOfMeasurements : public Feature {
 public:
  explicit ChartsOfMeasurements(Workbench& bench);
};

ChartsOfMeasurements::ChartsOfMeasurements(Workbench& bench) : Feature(bench) {
  auto* panel = new ChartPanel(session_, bench_.document.frames, bench_.document.jobs);
  QDockWidget* dock =
      bench_.addDock({"chart", tr("Chart of values"), panel, {Qt::RightDockWidgetArea, 55, false}});
  connect(dock, &QDockWidget::visibilityChanged, panel, &ChartPanel::setWatched);
  connect(&bench_.document.frames, &FrameService::ready, panel, &ChartPanel::showSelected);
  bench_.addAction({"measurementChart",
                    tr("Chart of values"),
                    {},
                    "",
                    false,
                    [dock](bool) {
                      dock->show();
                      dock->raise();
                    },
                    {{"measureMenu", 90}}});
}

}  // namespace

std::unique_ptr<Feature> makeMeasurementCharts(Workbench& bench) {
  return std::make_unique<ChartsOfMeasurements>(bench);
}

}  // namespace volumen
