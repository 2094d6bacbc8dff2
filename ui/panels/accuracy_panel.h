#pragma once

#include <QTreeWidget>

#include "ui/controller/draw_service.h"
#include "ui/controller/measured_levels.h"
#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

class QGridLayout;

namespace volumen {

/// The cost of accuracy for the scene on screen: the quality levels with measured times and errors. The user
/// chooses a level, or a time or error that selects one.
class AccuracyPanel : public QWidget {
  Q_OBJECT
 public:
  explicit AccuracyPanel(Session& session, QWidget* parent = nullptr);

  void showMeasured(const MeasuredLevels& measured);
  /// Shows the quality level of final pictures.
  void showLevel(PictureLevel level);
  /// Shows what is being measured. `share` is 0..1.
  void showProgress(const QString& what, double share);
  /// Shows the estimated error of the picture on screen, or why there is no estimate.
  void showEstimate(const ScreenPicture& frame);
  /// Sets whether the view shows the error instead of the picture.
  void setErrorWanted(bool wanted);

 Q_SIGNALS:
  void errorWanted(bool wanted);

 protected:
  void resizeEvent(QResizeEvent*) override;

 private:
  void makeTable();
  QLayout* sliderRow();
  /// Adds a limit to aim at: a box that switches it, and a field for it. `name` is the undo step.
  void addAim(QGridLayout& grid, Aim aim, double QualityGoal::*limit, const FieldText& text,
              const QString& name, const NumberFormat& format, double step);
  void choose(int row);
  void editGoal(const QString& text, const std::function<void(QualityGoal&)>& change);
  void showRow(int row);
  void showDifference();

  Session& session_;
  QSlider* slider_;
  QTreeWidget* table_;
  QCheckBox* showError_;
  QLabel *difference_, *caption_, *state_, *estimate_;
  MeasuredLevels measured_;
  PictureLevel level_;
};

}  // namespace volumen
