#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTreeWidget>

#include "io/dicom/attribute_list.h"
#include "io/study/series.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

namespace volumen {

/// All DICOM attributes of a picture of a series, read on a worker thread; searched by tag, name and value,
/// and copied. Follows the view in focus until another picture is chosen here.
class AttributesDialog : public QDialog {
  Q_OBJECT
 public:
  /// Begins with the picture in focus where that is of this series, else with its first.
  AttributesDialog(Session& session, const Series& series, QWidget* parent = nullptr);

 private:
  void makeLayout();
  void makeCopying();
  void follow();
  void showPicture(const Series& series, int index);
  void showTitle();
  void showNamesOrNot();
  void read();
  void showLines(const std::vector<dicom::AttributeLine>& lines);
  void filter();
  void copy(bool onlyChosen) const;

  Session& session_;
  Series series_;
  std::string path_;  // that is shown
  QSpinBox* slice_;
  QCheckBox* follow_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  QLabel* file_;
  JobLane lane_;
};

}  // namespace volumen
