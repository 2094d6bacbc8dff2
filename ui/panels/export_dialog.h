#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <vector>

#include "io/archive/archives.h"

namespace volumen {

/// Something that can be exported.
struct ExportChoice {
  QString text;
  bool isPicture = false;  ///< names may be drawn into it
  bool hasFace = false;    ///< may show a head of CT or MR, whose face can be taken away
};

/// Asks what of several things to export, where to, and whether with the patient's identity.
class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  /// `name` tells what the choices are of. Proposes the archive `archive`; without one of this name, a
  /// folder.
  ExportDialog(const QString& name, const std::vector<ExportChoice>& choices, const Archives& archives,
               const QString& archive, bool deidentified, QWidget* parent = nullptr);

  /// Returns the index of the choice.
  int choice() const { return choice_->currentIndex(); }
  /// Returns the index of the archive; -1 for a folder.
  int archive() const { return target_->currentIndex() - 1; }
  bool deidentified() const { return deidentified_->isChecked(); }
  /// Returns whether faces are to be taken away, too.
  bool faceless() const { return faceless_->isEnabled() && faceless_->isChecked(); }
  bool namesHidden() const { return hideNames_->isChecked() || deidentified(); }

 private:
  void enableFields();

  const std::vector<ExportChoice> choices_;
  QComboBox *choice_, *target_;
  QCheckBox *hideNames_, *deidentified_, *faceless_;
};

}  // namespace volumen
