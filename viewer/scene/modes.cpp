#include "viewer/scene/modes.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace volumen {

namespace {

class Largest : public RayProjection {
 public:
  void add(const ValuesInCell& values) override { value_ = std::max(value_, values.largest); }
  double value(double) const override { return value_; }

 private:
  double value_ = -std::numeric_limits<double>::infinity();
};

class Smallest : public RayProjection {
 public:
  void add(const ValuesInCell& values) override { value_ = std::min(value_, values.smallest); }
  double value(double) const override { return value_; }

 private:
  double value_ = std::numeric_limits<double>::infinity();
};

class Mean : public RayProjection {
 public:
  void add(const ValuesInCell& values) override {
    const auto& c = values.c;
    if (!first_) first_ = c[0];
    integral_ += values.lengthMm * ((c[0] - *first_) + c[1] / 2 + c[2] / 3 + c[3] / 4);
  }
  double value(double lengthMm) const override { return first_.value_or(0) + integral_ / lengthMm; }

 private:
  std::optional<double> first_;  // sums are relative to it, so that constants are exact
  double integral_ = 0;
};

template <class Projection>
std::unique_ptr<RayProjection> make() {
  return std::make_unique<Projection>();
}

}  // namespace

const std::vector<ModeRow>& modeRows() {
  static const std::vector<ModeRow> rows{
      {Mode::composite, "composite", "3D", Shows::surface, "", {}, true, nullptr},
      {Mode::mip, "mip", "MIP (maximum)", Shows::largest, "", {700, 1800}, true, make<Largest>},
      {Mode::minip, "minip", "MinIP (minimum)", Shows::smallest, "", {-700, 800}, true, make<Smallest>},
      {Mode::average, "average", "Average", Shows::wholeLine, "mean", {-300, 1400}, true, make<Mean>},
  };
  return rows;
}

const ModeRow& rowOf(Mode mode) { return modeRows().at(std::size_t(mode)); }

const char* modeName(Mode mode) { return rowOf(mode).name; }

}  // namespace volumen
