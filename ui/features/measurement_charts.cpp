#include <QDockWidget>

#include "ui/features/feature.h"
#include "ui/panels/chart_panel.h"

namespace volumen {

namespace {

// Shows charts of the values under measurements.
class MeasurementCharts : public Feature {
 public:
  explicit MeasurementCharts(Workbench& bench);

 private:
  ChartJobs jobs_;
};

MeasurementCharts::MeasurementCharts(Workbench& bench)
    : Feature(bench), jobs_(session_, bench.document.frames, bench.document.jobs) {
  auto* panel = new ChartPanel(session_, jobs_);
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
  return std::make_unique<MeasurementCharts>(bench);
}

}  // namespace volumen
