#include "ui/views/cine_player.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/workspace/cine.h"

namespace volumen {

CinePlayer::CinePlayer(const Cine& cine, int count, int first)
    : cine_(cine), count_(count), first_(first), told_(first) {
  clock_.start();
  connect(&timer_, &QTimer::timeout, this, [this] {
    const int now = due();
    if (std::exchange(told_, now) != now) Q_EMIT frameDue();
  });
  timer_.setTimerType(Qt::PreciseTimer);
  // Often enough that no frame is late by more than a quarter of its time.
  timer_.start(std::clamp(int(250 / cineRate(cine)), 1, 50));
}

int CinePlayer::due() const { return cineFrame(cine_, count_, first_, double(clock_.nsecsElapsed()) / 1e6); }

void CinePlayer::tellShown(int frame) {
  if (std::exchange(shown_, frame) == frame) return;
  shownAt_.push_back(double(clock_.nsecsElapsed()) / 1e6);
  // Those of a second, and at least some.
  const auto most = std::size_t(std::max(4.0, std::ceil(cineRate(cine_)))) + 1;
  if (shownAt_.size() > most) shownAt_.pop_front();
}

double CinePlayer::rate() const {
  const bool isLong = shownAt_.size() > 4 && shownAt_.back() - shownAt_.front() >= 950;
  return isLong ? 1000 * double(shownAt_.size() - 1) / (shownAt_.back() - shownAt_.front()) : 0;
}

bool CinePlayer::isLate() const {
  const double real = rate();
  return real > 0 && std::abs(real / cineRate(cine_) - 1) > 0.05;
}

}  // namespace volumen
