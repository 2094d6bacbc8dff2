#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <functional>
#include <optional>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/panels/segment_chart_box.h"
#include "ui/workspace/segment_report.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The numbers of all segments of the series that the panel Segments shows, a row each: sorted by a click on
/// a head, copied, saved as CSV and JSON; those that are chosen are drawn as charts, two are compared.
/// They follow the segments; strokes once they end.
class SegmentNumbersDialog : public QDialog {
  Q_OBJECT
 public:
  /// The painter outlives it.
  SegmentNumbersDialog(Session& session, Jobs& jobs, const SegmentPainter& painter,
                       QWidget* parent = nullptr);

 private:
  /// What was measured of what.
  struct Measured {
    std::vector<SegmentMap> maps;  // by their numbers
    VolumePtr volume;
    std::vector<SegmentReport> reports{};  // map after map
    bool isDone = false;
  };

  /// The voxels of a segment.
  struct Part {
    std::shared_ptr<const LabelMap> labels{};
    int number = 0;
    BitMask mask() const { return maskOf(*labels, std::uint8_t(number)); }
  };

  void makeLayout();
  void follow();
  void giveUp();
  void forget();
  void measure();
  void measureSurfaces();
  /// False, with the reason told: they are none.
  bool take(const Result<std::vector<SegmentReport>>& reports);
  void showMeasured();
  void fillTable();
  void showChoice();
  void compare();
  void copy() const;
  void askWhere(const QString& suffix, const std::function<QString()>& text);
  QStringList ofSeries() const;
  QString csvText() const;
  QString jsonText() const;
  ValueScale scale() const;
  std::vector<std::size_t> chosenReports() const;
  Part partOf(std::size_t report) const;

  Session& session_;
  const SegmentPainter& painter_;
  QTableWidget* table_;
  SegmentChartBox* charts_;
  QLabel* said_;
  QPushButton *compare_, *copy_, *saveCsv_, *saveJson_;
  std::optional<Measured> measured_;
  JobLane lane_;
};

}  // namespace volumen
