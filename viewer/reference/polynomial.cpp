#include "viewer/reference/polynomial.h"

#include <algorithm>
#include <cmath>

namespace volumen::reference {

namespace {

double valueAt(const double* c, int degree, double s) {
  double sum = c[degree];
  for (int n = degree - 1; n >= 0; --n) sum = sum * s + c[n];
  return sum;
}

// Returns false if all Bernstein coefficients over [0, 1] have one sign; then there is no root in between.
bool mayVanish(const double* c, int degree) {
  bool positive = false, negative = false;
  for (int n = 0; n <= degree; ++n) {
    double sum = c[0], ratio = 1;  // The ratio (n choose k) / (degree choose k).
    for (int k = 1; k <= n; ++k) {
      ratio *= double(n - k + 1) / (degree - k + 1);
      sum += ratio * c[k];
    }
    positive |= sum >= 0;
    negative |= sum <= 0;
  }
  return positive && negative;
}

// Returns the root between low and high, where the polynomial crosses 0. Uses Newton's method, with bisection
// where a step leaves the bracket.
double bracketedRoot(const double* c, const double* derivative, int degree, double low, double high) {
  const bool startsNegative = valueAt(c, degree, low) < 0;
  double s = (low + high) / 2;
  for (int n = 0; n < 100; ++n) {
    const double value = valueAt(c, degree, s);
    ((value < 0) == startsNegative ? low : high) = s;
    double next = s - value / valueAt(derivative, degree - 1, s);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double move = std::abs(next - s);
    s = next;
    if (move < 1e-15) break;
  }
  return s;
}

// Finds the sign changes: at most one lies between neighbouring roots of the derivative.
int signChanges(const double* c, int degree, double* places) {
  if (!mayVanish(c, degree)) return 0;
  double derivative[6], stops[7];
  for (int n = 0; n < degree; ++n) derivative[n] = (n + 1) * c[n + 1];
  int count = 1;
  stops[0] = 0;
  if (degree > 1) count += signChanges(derivative, degree - 1, stops + 1);
  stops[count] = 1;
  int found = 0;
  for (int n = 0; n < count; ++n)
    if ((valueAt(c, degree, stops[n]) < 0) != (valueAt(c, degree, stops[n + 1]) < 0))
      places[found++] = bracketedRoot(c, derivative, degree, stops[n], stops[n + 1]);
  return found;
}

void append(const double* c, int degree, std::vector<double>& places) {
  double found[6];
  const int count = signChanges(c, degree, found);
  places.insert(places.end(), found, found + count);
}

}  // namespace

Sextic squared(const Cubic& p) {
  Sextic out;
  for (int n = 0; n <= 3; ++n)
    for (int m = 0; m <= 3; ++m) out.c[n + m] += p.c[n] * p.c[m];
  return out;
}

Sextic squared(const CubicVector& p) {
  Sextic out;
  for (int n = 0; n <= 3; ++n)
    for (int m = 0; m <= 3; ++m) out.c[n + m] += glm::dot(p.c[n], p.c[m]);
  return out;
}

Sextic sum(Sextic a, double factor, const Sextic& b) {
  for (int n = 0; n <= 6; ++n) a.c[n] += factor * b.c[n];
  return a;
}

void appendSignChanges(const Cubic& p, std::vector<double>& places) { append(p.c.data(), 3, places); }
void appendSignChanges(const Sextic& p, std::vector<double>& places) { append(p.c.data(), 6, places); }

void appendExtremes(const Cubic& p, std::vector<double>& places) {
  const double derivative[3] = {p.c[1], 2 * p.c[2], 3 * p.c[3]};
  append(derivative, 2, places);
}

}  // namespace volumen::reference
