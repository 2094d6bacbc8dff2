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

/// Shows all DICOM attributes of a picture, read on a worker thread. Lines can be copied and searched by tag,
/// name and value. Follows the view in focus until the user chooses another picture.
class AttributesDialog : public QDialog {
  Q_OBJECT
 public:
  /// Shows the picture in focus if it belongs to `series`, else its first one.
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
  std::string path_;  // file of the shown picture
  QSpinBox* slice_;
  QCheckBox* follow_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  QLabel* file_;
  JobLane lane_;
};

}  // namespace volumen
