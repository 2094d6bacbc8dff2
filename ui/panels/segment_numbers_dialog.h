#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <functional>

#include "ui/controller/segment_painter.h"
#include "ui/derivations/segment_reports.h"
#include "ui/panels/segment_chart_box.h"
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
  /// Segments and their numbers as they are shown.
  struct Measured {
    std::vector<SegmentMap> maps;          // numbered as in the session
    ValueScale scale;                      // of the series
    SegmentReports::ValuePtr source{};     // null: none yet
    std::vector<SegmentReport> reports{};  // of `source`, with the present names
    bool isDone = false;                   // surfaces included
    QString said{};                        // about the series, or why numbers are missing
  };

  /// The voxels of one segment.
  struct Part {
    std::shared_ptr<const LabelMap> labels{};
    int number = 0;
    BitMask mask() const { return maskOf(*labels, std::uint8_t(number)); }
  };

  void makeLayout();
  void follow();
  void end();
  Measured measuredNow() const;
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
  Measured measured_;
  bool isOpen_ = true;
  SegmentReports reports_;
  JobLane lane_;  // compares
};

}  // namespace volumen
