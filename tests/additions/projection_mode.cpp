// An addition: a projection that shows the standard deviation of the values along a ray.
#include <algorithm>
#include <cmath>

#include "viewer/scene/modes.h"

namespace volumen {

namespace {

class Deviation : public RayProjection {
 public:
  void add(const ValuesInCell& values) override {
    for (int a = 0; a < 4; ++a) {
      mean_ += values.lengthMm * values.c[a] / (a + 1);
      for (int b = 0; b < 4; ++b) square_ += values.lengthMm * values.c[a] * values.c[b] / (a + b + 1);
    }
  }
  double value(double lengthMm) const override {
    const double mean = mean_ / lengthMm;
    return std::sqrt(std::max(0.0, square_ / lengthMm - mean * mean));
  }

 private:
  double mean_ = 0, square_ = 0;  // integrals of v and of v^2
};

}  // namespace

std::unique_ptr<RayProjection> makeDeviation() { return std::make_unique<Deviation>(); }

}  // namespace volumen
