#pragma once

#include <QDialog>

#include "io/archive/archives.h"
#include "ui/document/job_lane.h"

class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QSpinBox;

namespace volumen {

/// Edits the user's list of archives, which is written by Save. Fields of the file that are not shown here,
/// such as TLS, are kept. A file that cannot be read is told and not replaced.
class ArchivesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit ArchivesDialog(QWidget* parent = nullptr);

 private:
  // Makes the field for the value that the file calls `word`.
  QLineEdit* textField(const char* word, const QString& label, std::string Archive::*member);
  QFormLayout* form();
  void makeButtons();
  Archive* chosen();
  void showChosen();
  void add();
  void remove();
  void test();
  void save();
  // Returns why an archive cannot be used, in words of the dialog; empty if it can.
  QString problemOf(const Archive& archive) const;
  bool isValid();

  Archives archives_;
  QListWidget* list_;
  QWidget* fields_;
  std::vector<std::pair<QLineEdit*, std::string Archive::*>> texts_;
  QSpinBox* port_;
  QLabel* told_;
  JobLane tests_;
};

}  // namespace volumen
