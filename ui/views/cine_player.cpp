#include "ui/views/cine_player.h"

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <utility>

namespace volumen {

namespace {

std::function<double()> machineClock() {
  QElapsedTimer clock;
  clock.start();
  return [clock] { return double(clock.nsecsElapsed()) / 1e6; };
}

}  // namespace

CinePlayer::CinePlayer(Playable& what, const CineRound& round, std::function<double()> clock)
    : what_(what),
      round_(round),
      clock_(clock ? std::move(clock) : machineClock()),
      track_(what.cine(), round, what.stack().place.index),
      asked_(what.stack().place.index),
      seen_(clock_()) {
  connect(&timer_, &QTimer::timeout, this, &CinePlayer::tick);
  timer_.setTimerType(Qt::PreciseTimer);
  setRound(round);
}

void CinePlayer::setRound(const CineRound& round) {
  track_ = CineTrack(what_.cine(), round, track_.place(), track_.isBackwards());
  round_ = round;
  shownAt_.clear();  // the old times belong to another rate
  // The timer is fast enough that no position is late by more than a quarter of its duration.
  timer_.start(std::clamp(int(250 / wantedRate()), 1, 50));
  show();
}

void CinePlayer::end() {
  timer_.stop();
  disconnect();
  deleteLater();
}

double CinePlayer::wantedRate() const { return round_.rate > 0 ? round_.rate : cineRate(what_.cine()); }

void CinePlayer::show() {
  const int due = track_.place();
  if (std::exchange(asked_, due) == due) return;
  isGoing_ = true;
  what_.play(due);
  isGoing_ = false;
}

void CinePlayer::tick() {
  const double now = clock_(), passed = now - std::exchange(seen_, now);
  if (!isWhereItWent()) {
    Q_EMIT over();
    return;
  }
  const int most = what_.keepsTime() ? CineTrack::asManyAsAreDue : what_.isReady(track_.next()) ? 1 : 0;
  track_.pass(passed, most);
  show();
  if (track_.isOver()) Q_EMIT over();
}

void CinePlayer::tellShown(int place) {
  if (std::exchange(shown_, place) == place) return;
  shownAt_.push_back(clock_());
  // Keeps one second, and at least five times.
  const auto most = std::size_t(std::max(4.0, std::ceil(wantedRate()))) + 1;
  while (shownAt_.size() > most) shownAt_.pop_front();
}

double CinePlayer::rate() const {
  const bool isLong = shownAt_.size() > 4 && shownAt_.back() - shownAt_.front() >= 950;
  return isLong ? 1000 * double(shownAt_.size() - 1) / (shownAt_.back() - shownAt_.front()) : 0;
}

bool CinePlayer::isLate() const {
  const double real = rate();
  return real > 0 && std::abs(real / wantedRate() - 1) > 0.05;
}

}  // namespace volumen
