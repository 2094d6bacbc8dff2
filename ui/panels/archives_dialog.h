#pragma once

#include <QDialog>

#include "io/archive/archives.h"
#include "ui/document/job_lane.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QSpinBox;

namespace volumen {

/// Edits the user's list of archives, which is written by Save. Values of the protocol that is not chosen are
/// kept while the dialog is open. Fields of the file that are not shown here, such as TLS, are kept. A file
/// that cannot be read is told and not replaced.
class ArchivesDialog : public QDialog {
  Q_OBJECT
 public:
  /// Archives are tested on `tests`, which outlives the dialog: a host that does not answer cannot hold it
  /// up.
  explicit ArchivesDialog(JobLane& tests, QWidget* parent = nullptr);
  ~ArchivesDialog() override;

 private:
  void fillForm();
  // Adds the field for the value that the file calls `word`; shown with archives of `kind`, or with all.
  QLineEdit* addText(const char* word, const QString& label, std::string Archive::*member,
                     std::optional<ArchiveKind> kind = {});
  void showFieldsOfKind(ArchiveKind kind);
  void makeButtons();
  Archive* chosen();
  void showChosen();
  void add();
  void remove();
  void test();
  void save();
  // Returns a sentence about the file in words of the dialog.
  QString inWords(const std::string& problem) const;
  bool isValid();

  Archives archives_, asRead_;
  QListWidget* list_;
  QWidget* fields_;
  std::vector<std::pair<QLineEdit*, std::string Archive::*>> texts_;
  std::vector<std::pair<QWidget*, ArchiveKind>> ofKind_;  // fields of one protocol
  QFormLayout* form_;
  QComboBox* kind_;
  QSpinBox* port_;
  QLabel* told_;
  JobLane& tests_;
};

}  // namespace volumen
