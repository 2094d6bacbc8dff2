#pragma once

#include <algorithm>
#include <vector>

namespace volumen::reference {

/// A curve through points (at, value): linear between neighbours, constant outside. Points at the same `at`
/// form a step: the first is the limit from below, the last holds there and above (picture.md 4).
template <class T>
class Curve {
 public:
  void add(double at, T value) {
    at_.push_back(at);
    value_.push_back(value);
  }
  bool empty() const { return at_.empty(); }
  /// Returns where the formula changes, in ascending order.
  const std::vector<double>& places() const { return at_; }

  /// Returns the segment that holds x: -1 before the first point, n from point n on.
  int segment(double x) const { return int(std::upper_bound(at_.begin(), at_.end(), x) - at_.begin()) - 1; }
  /// The values at the two ends of a segment.
  T first(int segment) const { return value_[std::max(segment, 0)]; }
  T last(int segment) const { return value_[std::min<std::size_t>(segment + 1, value_.size() - 1)]; }
  /// Evaluates the formula of this segment at x. If rounding puts x outside, its nearer end is used.
  T operator()(int segment, double x) const {
    if (segment < 0 || segment + 1 == int(at_.size())) return first(segment);
    const double f = std::clamp((x - at_[segment]) / (at_[segment + 1] - at_[segment]), 0.0, 1.0);
    return first(segment) + f * (last(segment) - first(segment));
  }

 private:
  std::vector<double> at_;
  std::vector<T> value_;
};

}  // namespace volumen::reference
