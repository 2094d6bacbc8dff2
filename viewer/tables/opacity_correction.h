#pragma once

namespace volumen {

/// The series x (c0 + c1 x + c2 x^2 ...) for 1 - (1 - x)^unitDistances, to seven digits, for opacities x of 0
/// .. most. If `most` is 0 there is no series.
struct CorrectionSeries {
  static constexpr int mostTerms = 10;
  float unitDistances = 0;  ///< The interval's length in unit distances.
  float most = 0;
  int terms = 0;
  float c[mostTerms] = {};  ///< 0 from index `terms` on.
};

/// Makes the series for opacities up to `most`, or as far as the largest number of terms reaches. For
/// intervals of up to a unit that is at least 1/2.
CorrectionSeries makeCorrectionSeries(float unitDistances, double most);

}  // namespace volumen
