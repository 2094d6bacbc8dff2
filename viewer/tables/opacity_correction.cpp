#include "viewer/tables/opacity_correction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace volumen {

namespace {

// Returns (1 - (1 - x)^unitDistances) / x.
double ratio(double x, double unitDistances) {
  return x > 0 ? -std::expm1(unitDistances * std::log1p(-x)) / x : unitDistances;
}

// Returns the polynomial through the ratio's values at Chebyshev nodes of 0 .. most, one node per term.
std::vector<double> throughNodes(double unitDistances, double most, int terms) {
  std::vector<double> nodes(terms), differences(terms), c(terms);
  for (int n = 0; n < terms; ++n) {
    nodes[n] = most / 2 * (1 + std::cos(std::numbers::pi * (n + 0.5) / terms));
    differences[n] = ratio(nodes[n], unitDistances);
  }
  for (int order = 1; order < terms; ++order)
    for (int n = terms - 1; n >= order; --n)
      differences[n] = (differences[n] - differences[n - 1]) / (nodes[n] - nodes[n - order]);
  // Expands Newton's form, from the last factor on.
  for (int n = terms - 1; n >= 0; --n) {
    for (int k = terms - 1; k >= 1; --k) c[k] = c[k - 1] - nodes[n] * c[k];
    c[0] = differences[n] - nodes[n] * c[0];
  }
  return c;
}

// Requires accuracy also for sums in floats: no term is much larger than the sum.
bool isGoodEnough(const std::vector<double>& c, double unitDistances, double most) {
  constexpr int looks = 50;
  for (int n = 0; n <= looks; ++n) {
    const double x = most * n / looks, wanted = ratio(x, unitDistances);
    double sum = 0, sizes = 0;
    for (auto k = c.rbegin(); k != c.rend(); ++k) {
      sum = sum * x + *k;
      sizes = sizes * x + std::abs(*k);
    }
    if (!(std::abs(sum - wanted) <= 3e-8 * wanted && sizes <= 3 * wanted)) return false;
  }
  return true;
}

}  // namespace

CorrectionSeries makeCorrectionSeries(float unitDistances, double most) {
  if (!(unitDistances > 0 && most > 0)) return {};
  for (double reach = std::min(most, 0.5); reach > 1e-3; reach /= 2)
    for (int terms = 2; terms <= CorrectionSeries::mostTerms; ++terms) {
      const std::vector<double> c = throughNodes(unitDistances, reach, terms);
      if (!isGoodEnough(c, unitDistances, reach)) continue;
      CorrectionSeries s{unitDistances, float(reach), terms};
      std::copy(c.begin(), c.end(), s.c);
      return s;
    }
  return {};
}

}  // namespace volumen
