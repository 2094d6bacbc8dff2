#include "viewer/reference/integral.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen::reference {

namespace {

// A piece is split until two estimates of its contribution differ by at most this fraction of it, or by at
// most absoluteTolerance.
constexpr double relativeTolerance = 1e-5;
constexpr double absoluteTolerance = 2e-8;
// Below this weight (transmittance x opacity x brightness) the normals of a piece do not matter.
constexpr double unseenTurn = 1e-6;
// A ray ends where at most this fraction of the brightest light is left.
constexpr double unseen = 1e-6;
// The rule below cannot resolve a piece of a larger optical depth.
constexpr double largestDepth = 2;
// Cuts closer together than this (in cells) are due to rounding.
constexpr double shortestPiece = 1e-13;
constexpr int mostSplits = 50;

}  // namespace

Classifier::Classifier(const TransferFunction& function, const VoxelGeometry& geometry)
    : unitDistanceMm(function.unitDistance) {
  for (const CurvePoint& p : function.points) colourOpacity.add(p.value, glm::dvec4(p.colour, p.opacity));
  for (const GradientOpacityPoint& p : function.gradientOpacity) gradientFactor.add(p.gradient, p.factor);
  // Denser matter is a surface to a billionth of a voxel. The limit keeps the number of splits finite.
  const glm::dvec3 spacing = geometry.spacing();
  densestPerMm = 1e10 / std::min({spacing.x, spacing.y, spacing.z});
}

bool Classifier::visible(double low, double high) const {
  const int last = colourOpacity.segment(high);
  for (int n = colourOpacity.segment(low); n <= last; ++n)
    if (visible(n)) return true;
  return false;
}

bool Classifier::visible(int segment) const {
  return colourOpacity.first(segment).a > 0 || colourOpacity.last(segment).a > 0;
}

double Classifier::extinction(double opacity) const {
  constexpr double densest = 1 - 1.0 / (1 << 20);
  return std::min(-std::log1p(-std::min(opacity, densest)) / unitDistanceMm, densestPerMm);
}

bool RayIntegral::opaque() const { return transmittance_ * lighting_.brightest() < unseen; }

template <class Values>
bool RayIntegral::visible(const Values& values) const {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return classifier_.visible(*low, *high);
}

bool RayIntegral::add(const CellPiece& piece) {
  const auto values = cornerValues(volume_, piece.cell);
  if (!visible(values)) return true;
  value_ = interpolateAlong(values, piece.start, piece.move);
  if (!visible(controlPoints(value_, 0, 1))) return true;
  lengthMm_ = piece.lengthMm;
  const bool factors = !classifier_.gradientFactor.empty();
  if (factors || lighting_.directional()) {
    gradient_ = interpolateAlong(cornerGradients(volume_, piece.cell), piece.start, piece.move);
    const glm::dmat3 perMm = volume_.geometry().patientFromVoxelGradient();
    for (glm::dvec3& c : gradient_.c) c = perMm * c;
  }
  cutAtFormulaChanges();
  for (std::size_t n = 0; n + 1 < cuts_.size(); ++n) {
    const double a = cuts_[n], b = cuts_[n + 1], middle = (a + b) / 2;
    if (b - a < shortestPiece) continue;
    segment_ = classifier_.colourOpacity.segment(value_(middle));
    if (!classifier_.visible(segment_)) continue;
    if (factors) factorSegment_ = classifier_.gradientFactor.segment(glm::length(gradient_(middle)));
    integrate(a, b, gauss(a, b), mostSplits);
    if (opaque()) return false;
  }
  return true;
}

bool RayIntegral::cover(glm::dvec3 colour, double opacity) {
  colour_ += transmittance_ * opacity * colour;
  transmittance_ *= 1 - opacity;
  return !opaque();
}

void RayIntegral::cutAtFormulaChanges() {
  cuts_.assign({0, 1});
  const auto control = controlPoints(value_, 0, 1);
  const auto [low, high] = std::minmax_element(control.begin(), control.end());
  for (double place : classifier_.colourOpacity.places()) {
    if (place < *low || place > *high) continue;
    Cubic above = value_;
    above.c[0] -= place;
    appendSignChanges(above, cuts_);
  }
  if (lighting_.directional()) lighting_.appendKinks(gradient_, cuts_);
  for (double place : classifier_.gradientFactor.places()) {
    Sextic above = squared(gradient_);
    above.c[0] -= place * place;
    appendSignChanges(above, cuts_);
  }
  std::sort(cuts_.begin(), cuts_.end());
}

void RayIntegral::integrate(double a, double b, const Interval& whole, int splitsLeft) {
  const double middle = (a + b) / 2;
  const Interval first = gauss(a, middle), second = gauss(middle, b), halves = over(first, second);
  if (splitsLeft == 0 || agree(a, b, whole, halves)) {
    colour_ += transmittance_ * halves.colour;
    transmittance_ *= std::exp(-halves.depth);
    return;
  }
  integrate(a, middle, first, splitsLeft - 1);
  if (!opaque()) integrate(middle, b, second, splitsLeft - 1);
}

bool RayIntegral::agree(double a, double b, const Interval& whole, const Interval& halves) const {
  const double weight = transmittance_ * -std::expm1(-halves.depth);
  if (weight * lighting_.brightest() <= absoluteTolerance) return true;
  if (halves.depth > largestDepth) return false;
  if (weight * lighting_.brightest() > unseenTurn && !normalsKeepTogether(a, b)) return false;
  const double colourError = transmittance_ * largest(glm::abs(whole.colour - halves.colour));
  const double depthError = transmittance_ * std::abs(std::exp(-whole.depth) - std::exp(-halves.depth));
  const double added = std::max(weight, transmittance_ * largest(halves.colour));
  return std::max(colourError, depthError) <= relativeTolerance * added + absoluteTolerance;
}

// Tests the hull of the cubic's control points, so that no turn between two samples is missed.
bool RayIntegral::normalsKeepTogether(double a, double b) const {
  if (!lighting_.directional() && classifier_.gradientFactor.empty()) return true;
  glm::dvec3 axis(0), unit[4];
  int count = 0;
  for (const glm::dvec3& g : controlPoints(gradient_, a, b)) {
    const double length = glm::length(g);
    if (length == 0) continue;
    unit[count] = g / length;
    axis += unit[count++];
  }
  const double axisLength = glm::length(axis), cosine = lighting_.smoothCosine();
  return axisLength >= count * cosine && std::all_of(unit, unit + count, [&](const glm::dvec3& u) {
           return glm::dot(u, axis) >= cosine * axisLength;
         });
}

// Integrates with three Gauss points. The optical depth up to each comes from the collocation method on the
// same points.
RayIntegral::Interval RayIntegral::gauss(double a, double b) const {
  static const double root = std::sqrt(15.0);
  static const double node[3] = {0.5 - root / 10, 0.5, 0.5 + root / 10};
  static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  static const double upTo[3][3] = {{5.0 / 36, 2.0 / 9 - root / 15, 5.0 / 36 - root / 30},
                                    {5.0 / 36 + root / 24, 2.0 / 9, 5.0 / 36 - root / 24},
                                    {5.0 / 36 + root / 30, 2.0 / 9 + root / 15, 5.0 / 36}};
  const double mm = (b - a) * lengthMm_;
  Sample at[3];
  for (int n = 0; n < 3; ++n) at[n] = sample(a + node[n] * (b - a));
  Interval interval{glm::dvec3(0), 0};
  for (int n = 0; n < 3; ++n) {
    double depth = 0;
    for (int m = 0; m < 3; ++m) depth += mm * upTo[n][m] * at[m].extinctionPerMm;
    interval.colour += mm * weight[n] * at[n].extinctionPerMm * std::exp(-depth) * at[n].colour;
    interval.depth += mm * weight[n] * at[n].extinctionPerMm;
  }
  return interval;
}

RayIntegral::Sample RayIntegral::sample(double s) const {
  const glm::dvec4 classified = classifier_.colourOpacity(segment_, value_(s));
  double opacity = classified.a;
  if (opacity == 0) return {glm::dvec3(0), 0};
  const glm::dvec3 gradient = gradient_(s);
  if (!classifier_.gradientFactor.empty())
    opacity *= classifier_.gradientFactor(factorSegment_, glm::length(gradient));
  return {lighting_.shade(glm::dvec3(classified), gradient), classifier_.extinction(opacity)};
}

RayIntegral::Interval RayIntegral::over(const Interval& front, const Interval& back) {
  return {front.colour + std::exp(-front.depth) * back.colour, front.depth + back.depth};
}

}  // namespace volumen::reference
