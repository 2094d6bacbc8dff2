#include "tests/unit/promises/random_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace volumen::tests {
namespace {

constexpr Mode modes[] = {Mode::composite, Mode::mip, Mode::minip, Mode::average};

}  // namespace

const char* nameOf(Mode mode) {
  constexpr const char* names[] = {"composite", "mip", "minip", "average"};
  return names[int(mode)];
}

double timesThePromise(const PictureError& e, const Promise& promise) {
  if (std::isnan(e.rmse)) return std::numeric_limits<double>::infinity();
  return std::max({std::pow(10, (promise.leastPsnrDb - e.psnrDb) / 20), e.percentile99 / promise.most99,
                   e.maximum / promise.mostMaximum});
}

void RandomReport::add(const LevelResult& result) {
  Count& count = counts_[{result.family, result.mode, result.promise->quality}];
  ++count.cases;
  count.failed += result.failed;
  if (result.failed) failures_.push_back(result);
}

void RandomReport::addPicture(Family family, const Picture& picture, double illConditionedShare) {
  Pictures& p = pictures_[family];
  const double pixels = double(picture.rgba.size()) / 4;
  ++p.all;
  p.blank += std::equal(picture.rgba.begin() + 4, picture.rgba.end(), picture.rgba.begin());
  p.pixels += pixels;
  p.illConditioned += illConditionedShare * pixels;
  p.mostShare = std::max(p.mostShare, illConditionedShare);
}

void RandomReport::addEstimate(const std::string& name, const std::vector<float>& told,
                               const std::vector<double>& off) {
  constexpr double roundingOf255 = 1e-3;  // rounding of float pixels, including the background
  int beyond = 0;
  for (std::size_t n = 0; n < off.size(); ++n) beyond += off[n] > double(told[n]) + roundingOf255;
  estimated_ += std::int64_t(off.size());
  beyond_ += beyond;
  if (beyond > 0) mistold_.push_back({beyond, name});
}

void RandomReport::printCounts() const {
  std::fprintf(stderr, "\nrandom cases, failed of drawn:");
  for (Mode mode : modes) std::fprintf(stderr, "%14s", nameOf(mode));
  for (Family family : families)
    for (const Promise& promise : promises) {
      std::fprintf(stderr, "\n  %-14s%-14s", nameOf(family), promise.name);
      for (Mode mode : modes) {
        const auto found = counts_.find({family, mode, promise.quality});
        const Count count = found == counts_.end() ? Count{} : found->second;
        std::fprintf(stderr, "%7d/%6d", count.failed, count.cases);
      }
    }
}

void RandomReport::printPictures() const {
  for (const auto& [family, p] : pictures_)
    std::fprintf(
        stderr,
        "\n%s: %d pictures, %d of them blank; ill-conditioned %.3f %% of %.0f pixels, in a picture at "
        "most %.1f %%",
        nameOf(family), p.all, p.blank, 100 * p.illConditioned / p.pixels, p.pixels, 100 * p.mostShare);
}

void RandomReport::printWorst(Family family) const {
  std::vector<LevelResult> worst;
  for (const LevelResult& r : failures_)
    if (r.family == family) worst.push_back(r);
  std::stable_sort(worst.begin(), worst.end(), [](const LevelResult& a, const LevelResult& b) {
    return timesThePromise(a.error, *a.promise) > timesThePromise(b.error, *b.promise);
  });
  std::set<std::uint64_t> told;
  for (const LevelResult& r : worst) {
    if (told.size() >= 10 || !told.insert(r.seed).second) continue;
    std::fprintf(stderr, "\n  %s, seed %llu, %s: %.3g times the promise: %s", nameOf(family),
                 static_cast<unsigned long long>(r.seed), nameOf(r.mode),
                 timesThePromise(r.error, *r.promise), r.why.c_str());
  }
}

void RandomReport::printEstimates() const {
  std::fprintf(stderr, "\n%.4f %% of %lld pixels are farther off than their picture says; most often of",
               100 * shareBeyondEstimate(), static_cast<long long>(estimated_));
  auto most = mistold_;
  std::sort(most.rbegin(), most.rend());
  for (std::size_t n = 0; n < std::min<std::size_t>(most.size(), 10); ++n)
    std::fprintf(stderr, "\n  %s: %d", most[n].second.c_str(), most[n].first);
}

void RandomReport::print() const {
  printCounts();
  printPictures();
  printEstimates();
  if (!failures_.empty()) {
    std::fprintf(stderr, "\nthe worst cases, each at its worst level:");
    for (Family family : families) printWorst(family);
    std::fprintf(stderr,
                 "\none again, written to DIR for the command line: VOLUMEN_ONLY=TestRandomScenes "
                 "VOLUMEN_RANDOM_CASES=1 VOLUMEN_RANDOM_SEED=%llu VOLUMEN_FIGURES=1 VOLUMEN_RANDOM_SAVE=DIR "
                 "tst_promises",
                 static_cast<unsigned long long>(failures_.front().seed));
  }
  std::fprintf(stderr, "\n");
}

}  // namespace volumen::tests
