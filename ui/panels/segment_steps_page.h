#pragma once

#include <QPushButton>
#include <QToolButton>
#include <vector>

#include "ui/panels/step_fields.h"

namespace volumen {

/// The steps that change the current segment: a list with the fields of the one chosen, and the usual ones as
/// buttons.
class SegmentStepsPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentStepsPage(Session& session, QWidget* parent = nullptr);

  /// Shows what the current segment allows.
  void showSegments();

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);

 private:
  void fillKinds();
  void makeLayout();
  const StepKind& chosen() const;
  void showWhatCanBeDone();
  void apply(const StepKind& kind);

  Session& session_;
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
