#pragma once

#include <QComboBox>
#include <QLabel>
#include <QTimer>
#include <QToolButton>
#include <optional>

#include "ui/derivations/measurement_charts.h"
#include "ui/panels/chart_view.h"

namespace volumen {

/// Charts the values under the selected measurement: along a line, or as histogram of a region or over time.
class ChartPanel : public QWidget {
  Q_OBJECT
 public:
  ChartPanel(Session& session, FrameService& frames, Jobs& jobs, QWidget* parent = nullptr);

  /// Called when voxels of the selected measurement may have been loaded.
  void showSelected();
  /// Sets whether the panel is visible. Behind another tab it computes nothing.
  void setWatched(bool watched);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void offer(const std::vector<ChartKind>& kinds);
  bool isToRest(const Measurement& measurement, ChartKind kind);
  void drop();
  void showChart();
  void draw(const MeasuredChart& chart, const QString& sentence);

  Session& session_;
  FrameService& frames_;
  QLabel* said_;
  QComboBox* kind_;
  QToolButton* copy_;
  ChartView* view_;
  ChartKind preferred_ = ChartKind::histogram;  // kind last chosen for a region
  bool isWatched_ = false;
  std::optional<Measurement> overTime_;  // the last measurement requested over time
  QTimer atRest_;                        // fires once it has been unchanged for a while
  std::optional<ChartKey> wanted_;
  MeasurementCharts charts_;
};

}  // namespace volumen
