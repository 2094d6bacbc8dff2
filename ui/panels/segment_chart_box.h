#pragma once

#include <QComboBox>
#include <QLabel>
#include <QToolButton>
#include <optional>
#include <vector>

#include "ui/document/job_lane.h"
#include "ui/panels/chart_view.h"
#include "ui/workspace/segment_report.h"
#include "ui/workspace/segments_over_time.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The segments that are chosen in the table of numbers: how often they have which values, or their mean at
/// each time point. All time points are read, as a job, once that is asked for.
class SegmentChartBox : public QWidget {
  Q_OBJECT
 public:
  SegmentChartBox(const Session& session, Jobs& jobs, QWidget* parent = nullptr);

  /// The segments of these maps were measured, map after map; none: nothing was. Those that are chosen are
  /// drawn, or, where none is, all if they are few.
  void setMeasured(const std::vector<SegmentMap>& maps, const std::vector<SegmentReport>& reports,
                   const std::vector<std::size_t>& chosen);
  /// What was measured of them over time; null: that was not asked for, or is under way.
  const SegmentsOverTime* overTime() const { return overTime_ ? &*overTime_ : nullptr; }

 private:
  /// What values over time are made of; equal ones make equal values.
  struct Wanted {
    std::vector<std::pair<std::shared_ptr<const LabelMap>, int>> segments;  // with their number
    std::vector<SeriesKey> steps;
    ValueScale scale;
    bool operator==(const Wanted&) const = default;
  };

  void makeLayout();
  void offerKinds();
  void showChosen();
  Wanted wantedNow() const;
  void read(const Wanted& wanted);
  void draw(const MeasuredChart& chart, const QString& sentence);
  ValueScale scale() const;

  const Session& session_;
  QComboBox* kind_;
  QLabel* said_;
  QToolButton* copy_;
  ChartView* view_;
  std::vector<SegmentMap> maps_;
  std::vector<SegmentReport> reports_;
  std::vector<std::size_t> chosen_;
  std::optional<Wanted> wanted_;  // read, under way, or cancelled
  std::optional<SegmentsOverTime> overTime_;
  JobLane lane_;
};

}  // namespace volumen
