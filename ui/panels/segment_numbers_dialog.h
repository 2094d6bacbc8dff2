#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <functional>
#include <optional>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/segment_report.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The numbers of all segments of the series that the panel Segments shows, a row each: sorted by a click on
/// a head, copied, saved as CSV and JSON; two of them are compared. They follow the segments; strokes once
/// they end.
class SegmentNumbersDialog : public QDialog {
  Q_OBJECT
 public:
  /// The painter outlives it.
  SegmentNumbersDialog(Session& session, Jobs& jobs, const SegmentPainter& painter,
                       QWidget* parent = nullptr);

 private:
  /// What was measured of what.
  struct Measured {
    SegmentMap map;
    VolumePtr volume;
    std::vector<SegmentReport> reports{};
    bool isDone = false;
  };

  void makeLayout();
  void follow();
  void measure();
  void take(const Result<std::vector<SegmentReport>>& reports);
  void showMeasured();
  void fillTable();
  void showChoice();
  void compare();
  void copy() const;
  void askWhere(const QString& suffix, const std::function<QString()>& text);
  QString csvText() const;
  QString jsonText() const;
  ValueScale scale() const;
  std::vector<int> chosenNumbers() const;
  const SegmentReport* reportOf(int number) const;

  Session& session_;
  const SegmentPainter& painter_;
  QTableWidget* table_;
  QLabel* said_;
  QPushButton *compare_, *copy_, *saveCsv_, *saveJson_;
  std::optional<Measured> measured_;
  JobLane lane_;
};

}  // namespace volumen
