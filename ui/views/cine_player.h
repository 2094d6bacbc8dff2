#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <deque>

#include "io/study/cine.h"

namespace volumen {

/// Plays a clip by the clock: which frame is due, whatever was shown before, and how fast frames really come.
class CinePlayer : public QObject {
  Q_OBJECT
 public:
  CinePlayer(const Cine& cine, int count, int first);

  int due() const;
  /// A frame came on screen.
  void tellShown(int frame);
  /// Different frames a second, over the last one; 0 until that is over.
  double rate() const;
  /// Whether that is 5 % off what the file says.
  bool isLate() const;

 Q_SIGNALS:
  /// Another frame is due.
  void frameDue();

 private:
  const Cine cine_;
  const int count_, first_;
  QElapsedTimer clock_;
  QTimer timer_;
  int told_, shown_ = -1;
  std::deque<double> shownAt_;  // ms, the newest last
};

}  // namespace volumen
