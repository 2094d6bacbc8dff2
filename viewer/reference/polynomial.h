#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen::reference {

/// A polynomial in s, with coefficients in ascending powers. Along a straight piece of a ray inside one cell
/// (s = 0 .. 1) the trilinear density is a cubic. So is each component of the gradient, and |g|^2 is a
/// sextic.
template <class T, int degree>
struct Polynomial {
  std::array<T, degree + 1> c{};

  T operator()(double s) const {
    T sum = c[degree];
    for (int n = degree - 1; n >= 0; --n) sum = sum * s + c[n];
    return sum;
  }
};

using Cubic = Polynomial<double, 3>;
using CubicVector = Polynomial<glm::dvec3, 3>;
using Sextic = Polynomial<double, 6>;

/// Returns the four Bezier control points of p over [a, b]; p stays inside their convex hull there.
template <class T>
std::array<T, 4> controlPoints(const Polynomial<T, 3>& p, double a, double b) {
  const auto blossom = [&](double u, double v, double w) {
    return p.c[0] + p.c[1] * ((u + v + w) / 3) + p.c[2] * ((u * v + u * w + v * w) / 3) +
           p.c[3] * (u * v * w);
  };
  return {blossom(a, a, a), blossom(a, a, b), blossom(a, b, b), blossom(b, b, b)};
}

/// Returns p . direction.
inline Cubic dot(const CubicVector& p, glm::dvec3 direction) {
  Cubic out;
  for (int n = 0; n <= 3; ++n) out.c[n] = glm::dot(p.c[n], direction);
  return out;
}

/// Returns p^2.
Sextic squared(const Cubic& p);
/// Returns |p|^2.
Sextic squared(const CubicVector& p);
/// Returns a + factor b.
Sextic sum(Sextic a, double factor, const Sextic& b);

/// Appends every s in (0, 1) where p changes its sign, accurate to about 1e-14.
void appendSignChanges(const Cubic& p, std::vector<double>& places);
void appendSignChanges(const Sextic& p, std::vector<double>& places);
/// Appends every s in (0, 1) where p has a local extreme.
void appendExtremes(const Cubic& p, std::vector<double>& places);

}  // namespace volumen::reference
