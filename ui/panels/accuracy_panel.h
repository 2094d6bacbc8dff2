#pragma once

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QTreeWidget>

#include "ui/controller/draw_service.h"
#include "ui/controller/measured_levels.h"
#include "ui/workspace/session.h"

class QGridLayout;

namespace volumen {

/// What accuracy costs in time, for the scene on screen: the levels with their measured times and errors, one
/// of them chosen, or a time or an error asked for that chooses it.
class AccuracyPanel : public QWidget {
  Q_OBJECT
 public:
  explicit AccuracyPanel(Session& session, QWidget* parent = nullptr);

  void showMeasured(const MeasuredLevels& measured);
  /// The level that pictures at rest are drawn at.
  void showLevel(PictureLevel level);
  /// What is being measured, share 0..1.
  void showProgress(const QString& what, double share);
  /// How far the picture on show may be off, as it says itself, or why that is not known.
  void showEstimate(const ScreenPicture& frame);
  /// Whether the view shows that in place of the picture.
  void setErrorWanted(bool wanted);

 Q_SIGNALS:
  void errorWanted(bool wanted);

 protected:
  void resizeEvent(QResizeEvent*) override;

 private:
  void makeTable();
  QLayout* sliderRow();
  void addAim(QGridLayout& grid, int row, QCheckBox* box, QDoubleSpinBox* field, Aim aim,
              const QString& name);
  void choose(int row);
  void editGoal(const QString& text, const std::function<void(QualityGoal&)>& change);
  void showGoal(const QualityGoal& goal);
  void showRow(int row);
  void showDifference();

  Session& session_;
  QSlider* slider_;
  QTreeWidget* table_;
  QCheckBox *meetTime_, *meetError_, *showError_;
  QDoubleSpinBox *frameMs_, *error_;
  QLabel *difference_, *caption_, *state_, *estimate_;
  MeasuredLevels measured_;
  PictureLevel level_;
};

}  // namespace volumen
