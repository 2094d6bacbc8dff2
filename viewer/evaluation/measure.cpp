#include <algorithm>
#include <cmath>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

glm::ivec2 scaled(glm::ivec2 size, double share) {
  return glm::max(glm::ivec2(1), glm::ivec2(glm::round(glm::dvec2(size) * share)));
}

struct Variant {
  Plan plan;
  StudyRow row;
  std::vector<double> framesMs;
  double spentMs = 0;
};

// Returns true if the caches that `last` left do not serve a frame of `next`.
bool needsOtherCaches(const Plan& last, const Plan& next) {
  return last.method != next.method || last.resampler != next.resampler || last.bits != next.bits ||
         last.gradientOperator != next.gradientOperator || last.curve != next.curve;
}

class Measurement {
 public:
  Measurement(const StudyOptions& options, RenderCaches& caches, const StudyProgress& progress,
              const CancelToken& cancel)
      : options_(options), caches_(caches), progress_(progress), cancel_(cancel) {}

  Status planAll(const Scene& scene, const std::vector<Setting>& settings, AccuracyStudy& study) {
    auto first = makePlan(scene, caches_.facts(), settings.front().options);
    if (!first) return first.error();
    study.plan = std::move(*first);
    for (const Setting& setting : settings) {
      Variant v{{}, {}, {}, 0};
      v.row.setting = setting;
      RenderOptions options = setting.options;
      options.size = v.row.size = scaled(options.size, setting.resolution);
      auto plan = makePlan(study.plan.scene, caches_.facts(), options);
      if (plan) {
        v.plan = std::move(*plan);
        variants_.push_back(std::move(v));
      } else {
        study.leftOut.push_back(setting.knob + ", " + setting.value + ": " + plan.message());
      }
    }
    return {};
  }

  // Draws the first picture of every variant and records its errors and samples. Variants that cannot be
  // drawn are left out.
  Status drawOnce(AccuracyStudy& study) {
    for (std::size_t n = 0; n < variants_.size() && !cancel_.cancelled();) {
      if (progress_) progress_("drawing", n, variants_.size());
      Variant& v = variants_[n];
      const auto done = draw(v);
      if (!done && !cancel_.cancelled()) {
        study.leftOut.push_back(v.row.setting.knob + ", " + v.row.setting.value + ": " + done.message());
        variants_.erase(variants_.begin() + std::ptrdiff_t(n));
        continue;
      }
      if (done) describe(v, *done, study);
      ++n;
    }
    return cancel_.cancelled() ? Status(Error{"cancelled"}) : Status();
  }

  Status drawRounds() {
    for (int round = 0; round < options_.frames; ++round)
      for (std::size_t n = 0; n < variants_.size(); ++n) {
        Variant& v = variants_[n];
        if (cancel_.cancelled()) return Error{"cancelled"};
        const bool enough = int(v.framesMs.size()) >= options_.frames || v.spentMs > options_.mostMs;
        if (enough && !v.framesMs.empty()) continue;
        if (progress_) progress_("timing", round * variants_.size() + n, options_.frames * variants_.size());
        if (last_ && needsOtherCaches(*last_, v.plan))
          if (auto warm = draw(v, false); !warm) return warm.error();
        if (auto timed = draw(v); !timed) return timed.error();
      }
    return {};
  }

  std::vector<StudyRow> rows() {
    std::vector<StudyRow> out;
    for (Variant& v : variants_) {
      v.row.medianMs = median(v.framesMs);
      v.row.minimumMs = minimum(v.framesMs);
      v.row.frames = int(v.framesMs.size());
      out.push_back(std::move(v.row));
    }
    return out;
  }

 private:
  // Draws one frame. Records its time if no cache had to be filled for it.
  Result<Rendered> draw(Variant& v, bool timed = true) {
    const double begin = wallMs();
    auto done = render(v.plan, caches_, cancel_);
    const double ms = wallMs() - begin;
    v.spentMs += ms;
    const bool sameCaches = last_ && !needsOtherCaches(*last_, v.plan);
    // Facts, gradients, copies and textures take at least this long to make. A row that is slow anyway is not
    // drawn again because of them.
    constexpr double madeSomething = 1;
    const bool counts =
        (sameCaches && done && done->stats.gradientsMs < madeSomething) || ms > options_.mostMs;
    if (done && timed && counts) v.framesMs.push_back(ms - done->stats.gradientsMs);
    last_ = v.plan;
    return done;
  }

  void describe(Variant& v, const Rendered& done, AccuracyStudy& study) {
    StudyRow& row = v.row;
    const RenderStats& s = done.stats;
    row.method = methodName(row.setting.options);
    row.stepVoxels = done.plan.stepVoxels;
    row.bits = v.plan.bits;
    row.bytes = s.densityBytes + s.gradientBytes + s.blockBytes + s.tableBytes;
    row.resampled = s.resampled, row.shaded = s.shaded, row.composited = s.composited;
    row.pixels = atPixelsOf(study.truth, done.picture);
    row.error = compare(row.pixels, study.truth.picture, study.truth.well);
    study.threads = s.threads;
    if (v.plan.resampler == Resampler::cpu) study.kernel = s.kernel;
  }

  const StudyOptions& options_;
  RenderCaches& caches_;
  const StudyProgress& progress_;
  const CancelToken& cancel_;
  std::vector<Variant> variants_;
  std::optional<Plan> last_;  ///< Plan of the frame before.
};

}  // namespace

Result<AccuracyStudy> measure(const Scene& scene, const std::vector<Setting>& settings,
                              const StudyOptions& options, RenderCaches& caches,
                              const StudyProgress& progress, const CancelToken& cancel) {
  AccuracyStudy study;
  Measurement measurement(options, caches, progress, cancel);
  if (Status s = measurement.planAll(scene, settings, study); !s) return s.error();
  const RenderOptions& first = settings.front().options;
  auto truth = makeTruth(study.plan.scene, *caches.volume(), first.size, options.mostPixels, first.threads,
                         progress, cancel);
  if (!truth) return truth.error();
  study.truth = std::move(*truth);
  if (Status s = measurement.drawOnce(study); !s) return s.error();
  if (Status s = measurement.drawRounds(); !s) return s.error();
  study.rows = measurement.rows();
  std::vector<glm::dvec2> points;
  for (const StudyRow& row : study.rows) points.emplace_back(row.medianMs, row.error.rmse);
  const std::vector<bool> front = paretoFront(points);
  for (std::size_t n = 0; n < front.size(); ++n) study.rows[n].front = front[n];
  return study;
}

std::vector<bool> paretoFront(const std::vector<glm::dvec2>& points) {
  std::vector<bool> front;
  for (const glm::dvec2& p : points)
    front.push_back(std::none_of(points.begin(), points.end(), [&](const glm::dvec2& q) {
      return q.x <= p.x && q.y <= p.y && (q.x < p.x || q.y < p.y);
    }));
  return front;
}

}  // namespace volumen
