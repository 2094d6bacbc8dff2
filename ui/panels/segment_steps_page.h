#pragma once

#include <QPushButton>
#include <QToolButton>
#include <vector>

#include "ui/controller/segment_editing.h"
#include "ui/panels/step_fields.h"

namespace volumen {

/// The steps that change the current segment: a list with the fields of the chosen one, and common ones as
/// buttons.
class SegmentStepsPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentStepsPage(SegmentEditing& editing, QWidget* parent = nullptr);

  /// Updates the page for the current segment.
  void showSegments();

 private:
  void fillKinds();
  const StepKind& chosen() const;
  void showWhatCanBeDone();
  void apply(const StepKind& kind);

  SegmentEditing& editing_;
  QComboBox* kinds_;
  StepFields* fields_;
  QPushButton* apply_;
  struct UsualStep {
    const StepKind* kind;
    QToolButton* button;
  };
  std::vector<UsualStep> usual_;
};

}  // namespace volumen
