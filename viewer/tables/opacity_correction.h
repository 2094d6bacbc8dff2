#pragma once

namespace volumen {

/// 1 - (1 - x)^unitDistances for opacities x of 0 .. most: x (c0 + c1 x + c2 x^2 ...), to seven digits. Where
/// most is 0 there is none.
struct CorrectionSeries {
  static constexpr int mostTerms = 10;
  float unitDistances = 0;  ///< the interval's length in unit distances
  float most = 0;
  int terms = 0;
  float c[mostTerms] = {};  ///< 0 from the terms-th on
};

/// Of opacities up to `most`, or as far as so many terms reach: at least to 1/2 for intervals of up to a
/// unit.
CorrectionSeries makeCorrectionSeries(float unitDistances, double most);

}  // namespace volumen
