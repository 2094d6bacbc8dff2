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

/// The numbers of all segments of the series in the Segments panel, a row each. A click on a head sorts them.
/// Copies them and saves CSV or JSON. Draws charts of selected segments and compares two. Follows changes of
/// segments, and strokes at their end.
class SegmentNumbersDialog : public QDialog {
  Q_OBJECT
 public:
  /// `painter` must outlive the dialog.
  SegmentNumbersDialog(Session& session, Jobs& jobs, const SegmentPainter& painter,
                       QWidget* parent = nullptr);

 private:
  /// Measured segments and their numbers.
  struct Measured {
    std::vector<SegmentMap> maps;  // numbered as in the session
    VolumePtr volume;
    std::vector<SegmentReport> reports{};  // map after map
    bool isDone = false;
  };

  /// The voxels of one segment.
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
  /// Returns false and reports the reason if measuring failed.
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
