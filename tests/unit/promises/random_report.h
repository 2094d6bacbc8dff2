#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_cases.h"

namespace volumen::tests {

/// The result of one level of one random case.
struct LevelResult {
  Family family;
  std::uint64_t seed;
  Mode mode;
  const Promise* promise;
  PictureError error;
  bool failed;      ///< by error, bytes or non-finite numbers
  std::string why;  ///< description of the failures
};

/// Returns "composite" and so on.
const char* nameOf(Mode mode);

/// Returns the largest ratio of an error's measures to the promise; at most 1 if it is kept.
double timesThePromise(const PictureError& error, const Promise& promise);

/// Collects statistics of random cases.
class RandomReport {
 public:
  void add(const LevelResult& result);
  /// Adds the reference picture of a case.
  void addPicture(Family family, const Picture& picture, double illConditionedShare);
  /// Counts pixels whose error `off` exceeds the estimate `told` of their picture (both in /255).
  void addEstimate(const std::string& name, const std::vector<float>& told, const std::vector<double>& off);
  /// Returns the share of pixels passed to addEstimate whose error exceeds the estimate.
  double shareBeyondEstimate() const { return estimated_ == 0 ? 0 : double(beyond_) / double(estimated_); }
  /// Prints to stderr: failures by family, mode and level, the share of ill-conditioned pixels, and the worst
  /// cases. Also prints how to draw a case again.
  void print() const;

 private:
  struct Count {
    int cases = 0, failed = 0;
  };
  struct Pictures {
    int all = 0, blank = 0;  ///< blank pictures have a single colour
    double pixels = 0, illConditioned = 0;
    double mostShare = 0;  ///< largest share of ill-conditioned pixels in a picture
  };
  void printCounts() const;
  void printPictures() const;
  void printEstimates() const;
  void printWorst(Family family) const;

  std::map<std::tuple<Family, Mode, Quality>, Count> counts_;
  std::map<Family, Pictures> pictures_;
  std::vector<LevelResult> failures_;
  std::int64_t estimated_ = 0, beyond_ = 0;           ///< pixels
  std::vector<std::pair<int, std::string>> mistold_;  ///< pictures with such pixels, and their number
};

}  // namespace volumen::tests
