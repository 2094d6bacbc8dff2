#pragma once

#include <QComboBox>
#include <QLabel>
#include <QPointer>
#include <QTimer>
#include <QToolButton>
#include <optional>

#include "ui/controller/chart_jobs.h"
#include "ui/panels/chart_view.h"

namespace volumen {

/// The values under the measurement that is selected: along a line, of a region how often and over time.
class ChartPanel : public QWidget {
  Q_OBJECT
 public:
  ChartPanel(Session& session, ChartJobs& jobs, QWidget* parent = nullptr);

  /// What is there may have come into memory.
  void showSelected();
  /// Whether it is seen: behind another tab nothing is worked out for it.
  void setWatched(bool watched);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void makeLayout();
  void offer(const std::vector<ChartKind>& kinds);
  bool isToRest(const Measurement& measurement, ChartKind kind);
  void take(int measurement, const MeasuredChart& chart);
  void say(const QString& sentence);

  Session& session_;
  QPointer<ChartJobs> jobs_;  // it may be gone before the window hides
  QLabel* said_;
  QComboBox* kind_;
  QToolButton* copy_;
  ChartView* view_;
  ChartKind preferred_ = ChartKind::histogram;  // of regions: the one chosen last
  bool isWatched_ = false;
  std::optional<Measurement> overTime_;  // the last that was to be drawn over time
  QTimer atRest_;                        // once it was not changed for a while
};

}  // namespace volumen
