#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/promises/promises.h"
#include "tests/unit/promises/random_cases.h"

namespace volumen::tests {

/// What came of one level of one random case.
struct LevelResult {
  Family family;
  std::uint64_t seed;
  Mode mode;
  const Promise* promise;
  PictureError error;
  bool failed;      ///< in any way: error, bytes, numbers
  std::string why;  ///< the failures in words
};

/// "composite" and so on.
const char* nameOf(Mode mode);

/// By how many times an error is beyond its promise, the worst of its measures; at most 1 where it is kept.
double timesThePromise(const PictureError& error, const Promise& promise);

/// Counts of what random cases showed.
class RandomReport {
 public:
  void add(const LevelResult& result);
  /// Of the reference of a case.
  void addPicture(Family family, const Picture& picture, double illConditionedShare);
  /// Counts pixels that are farther off than their picture says (both /255).
  void addEstimate(const std::string& name, const std::vector<float>& told, const std::vector<double>& off);
  /// The share of pixels that are farther off than was told, of all that addEstimate was given.
  double shareBeyondEstimate() const { return estimated_ == 0 ? 0 : double(beyond_) / double(estimated_); }
  /// Failures by family, mode and level, the share of ill-conditioned pixels, the worst cases, and how to
  /// draw one again; on stderr.
  void print() const;

 private:
  struct Count {
    int cases = 0, failed = 0;
  };
  struct Pictures {
    int all = 0, blank = 0;  ///< blank: of one colour
    double pixels = 0, illConditioned = 0;
    double mostShare = 0;  ///< of ill-conditioned pixels in a picture
  };
  void printCounts() const;
  void printPictures() const;
  void printEstimates() const;
  void printWorst(Family family) const;

  std::map<std::tuple<Family, Mode, Quality>, Count> counts_;
  std::map<Family, Pictures> pictures_;
  std::vector<LevelResult> failures_;
  std::int64_t estimated_ = 0, beyond_ = 0;           ///< pixels
  std::vector<std::pair<int, std::string>> mistold_;  ///< pictures with such pixels, and how many
};

}  // namespace volumen::tests
