#pragma once

#include <QComboBox>
#include <QLabel>
#include <QToolButton>
#include <optional>
#include <vector>

#include "results/numbers/segment_report.h"
#include "results/numbers/segments_over_time.h"
#include "results/series/time_steps.h"
#include "ui/document/derivation.h"
#include "ui/panels/chart_view.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Charts the segments selected in the table of numbers: histograms, or means over time. A job reads all time
/// points when the user asks for that chart.
class SegmentChartBox : public QWidget {
  Q_OBJECT
 public:
  SegmentChartBox(const Session& session, Jobs& jobs, QWidget* parent = nullptr);

  /// Sets the measured segments, map after map; empty if nothing was measured. Draws the segments in
  /// `chosen`. If that is empty, draws all segments if they are few.
  void setMeasured(const std::vector<SegmentMap>& maps, const std::vector<SegmentReport>& reports,
                   const std::vector<std::size_t>& chosen);
  /// Returns the values over time, or null if they were not requested or are being computed.
  const SegmentsOverTime* overTime() const;

 private:
  /// The inputs of values over time.
  struct OverTimeKey {
    std::vector<std::pair<std::shared_ptr<const LabelMap>, int>> segments;  // label maps with segment numbers
    std::vector<SeriesKey> steps;
    ValueScale scale;
    bool operator==(const OverTimeKey&) const = default;
  };

  void offerKinds();
  void showChosen();
  using OverTime = Derivation<OverTimeKey, SegmentsOverTime>;

  OverTime::Rule overTimeRule();
  OverTimeKey keyNow() const;
  TimeSteps wholeSteps() const;
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
  std::optional<OverTimeKey> wanted_;  // once the user has asked for it
  OverTime overTime_;
};

}  // namespace volumen
