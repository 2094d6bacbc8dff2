#pragma once

#include <QSlider>
#include <QTimer>

#include "ui/workspace/session.h"

namespace volumen {

/// The steps in time, echo, diffusion weight or direction of what a view shows; hidden where there is one.
class TimeBar : public QSlider {
  Q_OBJECT
 public:
  TimeBar(Session& session, ViewId view, QWidget* parent);

  bool hasSteps() const { return maximum() > 0; }
  /// So many steps on; stays within them.
  void step(int steps);
  /// Shows one after the other, from the first again after the last; or stops.
  void togglePlay();

 Q_SIGNALS:
  /// Of hasSteps() or which of them is shown.
  void stepsChanged();

 private:
  void showSteps();
  void goTo(int index);
  void playNext();

  Session& session_;
  const ViewId view_;
  QTimer timer_;
};

}  // namespace volumen
