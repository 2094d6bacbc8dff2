#include "ui/controller/accuracy_meter.h"

#include <numeric>

#include "viewer/evaluation/statistics.h"

namespace volumen {

namespace {

constexpr int mostPixels = 3072;  // pixels of the reference; takes some seconds at most
// Frames drawn for each level; a level that has taken `enoughMs` gets no more.
constexpr int frames = 3;
constexpr double enoughMs = 600;

}  // namespace

AccuracyMeter::AccuracyMeter(DrawService& drawService, QObject* parent)
    : QObject(parent), drawService_(drawService) {
  connect(&drawService_, &DrawService::trialReady, this, &AccuracyMeter::take);
}

void AccuracyMeter::show(VolumePtr volume, const Scene& complete, QSize pixels) {
  Shown shown{std::move(volume), complete, pixels};
  if (shown_ == shown) return;
  forget();
  shown_ = std::move(shown);
  if (wanted()) start();
}

void AccuracyMeter::forget() {
  stop();
  if (!shown_) return;
  shown_.reset();
  measured_ = {};
  Q_EMIT changed();
}

void AccuracyMeter::setWatched(bool watched) {
  watched_ = watched;
  startOrStop();
}

void AccuracyMeter::setNeeded(bool needed) {
  needed_ = needed;
  startOrStop();
}

void AccuracyMeter::startOrStop() {
  if (!wanted())
    stop();
  else if (shown_)
    start();
}

void AccuracyMeter::start() {
  const auto& levels = measured_.levels;
  if (running_ || (!levels.empty() && levels.back().done())) return;
  running_ = true;
  if (measured_.levels.empty())
    for (const PictureLevel level : pictureLevels()) measured_.levels.emplace_back().level = level;
  Q_EMIT changed();
  if (measured_.truth)
    drawNext();
  else
    computeTruth();
}

void AccuracyMeter::stop() {
  if (!running_) return;
  running_ = false;
  lane_.giveUpAll();
  drawService_.dropTrial();
  Q_EMIT cancelled();
}

void AccuracyMeter::computeTruth() {
  lane_.run(
      {},
      [this, shown = *shown_](const Job& job) {
        const auto progress = [&](const char*, std::size_t done, std::size_t total) {
          lane_.tell(job, [this, share = double(done) / double(total)] {
            Q_EMIT progressed(tr("reference"), share);
          });
        };
        return makeTruth(shown.scene, *shown.volume, {shown.pixels.width(), shown.pixels.height()},
                         mostPixels, 0, progress, job.cancel());
      },
      [this](Result<Truth> truth) { takeTruth(std::make_shared<const Truth>(std::move(*truth))); });
}

void AccuracyMeter::takeTruth(std::shared_ptr<const Truth> truth) {
  measured_.truth = std::move(truth);
  Q_EMIT changed();
  drawNext();
}

void AccuracyMeter::drawNext() {
  auto& levels = measured_.levels;
  next_ = 0;
  while (next_ < levels.size() && levels[next_].done()) ++next_;
  if (next_ == levels.size()) {
    running_ = false;
    Q_EMIT finished();
    return;
  }
  framesMs_.clear();
  Q_EMIT progressed(QString::fromStdString(levelName(levels[next_].level)),
                    double(next_) / double(levels.size()));
  awaited_ = drawService_.requestTrial(shown_->volume, shown_->scene, shown_->pixels, levels[next_].level);
}

void AccuracyMeter::take(const Trial& trial) {
  if (!running_ || trial.number != awaited_) return;
  MeasuredLevel& level = measured_.levels[next_];
  if (trial.drawn) {
    framesMs_.push_back(trial.ms);
    const double spentMs = std::accumulate(framesMs_.begin(), framesMs_.end(), 0.0);
    if (int(framesMs_.size()) < frames && spentMs < enoughMs) {
      awaited_ = drawService_.requestTrial(shown_->volume, shown_->scene, shown_->pixels, level.level);
      return;
    }
    describe(level, trial);
  } else {
    level.failure = trial.failure.toStdString();
  }
  markFront(measured_.levels);
  Q_EMIT changed();
  drawNext();
}

void AccuracyMeter::describe(MeasuredLevel& level, const Trial& trial) const {
  const Truth& truth = *measured_.truth;
  const Picture& picture = trial.drawn->picture;
  level.pixels = {truth.grid, picture.transparent, {}};
  for (const glm::ivec2 pixel : truth.pixels) {
    const glm::vec4 p = enlargedPixel(picture, level.level.edge, trial.pixels, pixel);
    level.pixels.rgba.insert(level.pixels.rgba.end(), &p[0], &p[0] + 4);
  }
  level.error = compare(level.pixels, truth.picture, truth.well);
  level.ms = median(framesMs_);
  level.plan = std::make_shared<const Plan>(trial.drawn->plan);
}

}  // namespace volumen
