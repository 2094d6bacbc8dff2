#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTreeWidget>

#include "io/study/series.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// All DICOM attributes of a slice of a series, read on a worker thread; searched by tag, name and value.
class AttributesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit AttributesDialog(const Series& series, QWidget* parent = nullptr);

 private:
  void makeLayout();
  void read();
  void filter();

  const Series series_;
  QSpinBox* slice_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  QLabel* file_;
  JobLane lane_;
};

}  // namespace volumen
