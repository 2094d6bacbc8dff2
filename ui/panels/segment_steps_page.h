#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QToolButton>
#include <vector>

#include "ui/controller/segment_jobs.h"
#include "ui/controller/segment_steps.h"

namespace volumen {

/// The steps that change the current segment, a button each.
class SegmentStepsPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentStepsPage(Session& session, QWidget* parent = nullptr);

  /// Shows what the current segment allows.
  void showSegments();

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);

 private:
  void makeLayout();
  void showOthers();
  QString whyNot(const SegmentStep& step) const;
  void run(const SegmentStep& step);

  Session& session_;
  QDoubleSpinBox *mm_, *ml_;
  QComboBox* other_;
  struct StepButton {
    const SegmentStep* step;
    QToolButton* button;
  };
  std::vector<StepButton> buttons_;
};

}  // namespace volumen
