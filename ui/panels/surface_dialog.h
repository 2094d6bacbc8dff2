#pragma once

#include <QDialog>
#include <memory>
#include <vector>

#include "io/export/export_segments.h"
#include "results/segments/segments.h"
#include "ui/document/job_lane.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QTableWidget;

namespace volumen {

/// Surfaces ready to be written.
using SurfacesToWrite = std::shared_ptr<const std::vector<SurfaceToWrite>>;

/// Makes the surfaces of segments with chosen options, and shows their triangles, volumes and areas before
/// they are saved.
class SurfaceDialog : public QDialog {
  Q_OBJECT
 public:
  /// Requires maps with labels.
  SurfaceDialog(std::vector<SegmentMap> maps, Jobs& jobs, QWidget* parent = nullptr);

  SurfaceWriting writing() const;
  /// Returns the surfaces made by these options. Not null after the dialog was accepted.
  const SurfacesToWrite& surfaces() const { return surfaces_; }

 private:
  void addChoices(QFormLayout& form);
  void make();
  void take(Result<std::vector<SurfaceToWrite>> made);
  void fillTable();

  const std::vector<SegmentMap> maps_;
  QComboBox* files_;
  QCheckBox* reduce_;
  QDoubleSpinBox* byMm_;
  QCheckBox* largest_;
  QTableWidget* table_;
  QLabel* said_;
  QPushButton* save_;
  SurfacesToWrite surfaces_;  // null while they are being made
  JobLane lane_;
};

}  // namespace volumen
