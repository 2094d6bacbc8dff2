// Generates the rays of a picture.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/generate_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "viewer/kernels/generate_rays.h"
#include "viewer/kernels/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;

HWY_INLINE VD SetD(double x) { return hn::Set(DD(), x); }

struct D3 {
  VD x, y, z;
};
HWY_INLINE D3 Broadcast(const glm::dvec3& v) { return {SetD(v.x), SetD(v.y), SetD(v.z)}; }
HWY_INLINE VD Dot(const D3& a, const D3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// The positions of pixel centres in the picture, in mm from its middle.
struct PlacesMm {
  VD right, up;
};

class RayMaker {
 public:
  RayMaker(const ViewRays& f, const RayParts* parts, RayRow& row)
      : f_(f),
        parts_(parts),
        row_(row),
        target_(f.target),
        right_(f.voxelFromMm * f.axes.right),
        up_(f.voxelFromMm * f.axes.up),
        direction_(f.voxelFromMm * f.axes.direction) {}

  void Make() {
    row_.parallel = !f_.perspective;
    const Lines shared = LinesThrough({hn::Zero(DD()), hn::Zero(DD())});
    if (row_.parallel) {
      row_.sharedStepMm = float(f_.sharedStepMm);
      row_.sharedMove = glm::vec3(direction_ * f_.sharedStepMm);
    }
    for (int n = 0; n < int(row_.pixel.size()); n += int(hn::Lanes(DD()))) {
      const VD pixel = hn::PromoteTo(DD(), hn::LoadU(hn::Rebind<std::int32_t, DD>(), row_.pixel.data() + n));
      const PlacesMm places = PlacesOf(pixel);
      const D3 origin = Sum(target_, right_, places.right, up_, places.up);
      const Lines lines = f_.perspective ? LinesThrough(places) : shared;
      Intervals inside = InsideOf(n, origin, lines);
      inside.any = hn::And(inside.any, hn::Ge(pixel, hn::Zero(DD())));
      Write(n, origin, lines, inside);
    }
  }

 private:
  /// Straight lines through the picture: the direction per mm (voxel space) and the length of a step of
  /// picture.md 9. Also the position of the eye on each line (mm from the picture) and the direction to it
  /// (patient space).
  struct Lines {
    D3 along;
    VD stepMm, eyeMm;
    D3 towardsViewer;
  };
  /// The parts of lines from t0 to t1, in mm from the picture, for the lines in `any`.
  struct Intervals {
    VD t0, t1;
    MD any;
  };

  static HWY_INLINE D3 Sum(const glm::dvec3& a, const glm::dvec3& b, VD timesB, const glm::dvec3& c,
                           VD timesC) {
    const auto component = [&](int n) {
      return hn::Add(SetD(a[n]), hn::Add(hn::Mul(SetD(b[n]), timesB), hn::Mul(SetD(c[n]), timesC)));
    };
    return {component(0), component(1), component(2)};
  }
  static HWY_INLINE D3 Scale(const D3& v, VD s) {
    return {hn::Mul(v.x, s), hn::Mul(v.y, s), hn::Mul(v.z, s)};
  }

  HWY_INLINE PlacesMm PlacesOf(VD pixel) const {
    const double width = f_.size.x, pixelMm = f_.heightMm / f_.size.y;
    const VD y = hn::Floor(hn::Mul(hn::Add(pixel, SetD(0.5)), SetD(1 / width)));
    const VD x = hn::Sub(pixel, hn::Mul(y, SetD(width)));
    return {hn::Mul(hn::Sub(x, SetD(0.5 * width - 0.5)), SetD(pixelMm)),
            hn::Mul(hn::Sub(SetD(0.5 * f_.size.y - 0.5), y), SetD(pixelMm))};
  }

  HWY_INLINE Lines LinesThrough(const PlacesMm& p) const {
    Lines lines;
    const glm::dvec3 towardsCamera = -f_.axes.direction;
    lines.towardsViewer = Broadcast(towardsCamera);
    lines.along = Broadcast(direction_);
    lines.stepMm = SetD(f_.sharedStepMm);
    lines.eyeMm = SetD(-std::numeric_limits<double>::infinity());
    if (f_.perspective) {
      const double far = f_.distanceMm;
      const VD toEye =
          hn::Sqrt(hn::Add(SetD(far * far), hn::Add(hn::Mul(p.right, p.right), hn::Mul(p.up, p.up))));
      const VD aMm = hn::Div(SetD(1), toEye);
      lines.along = Scale(Sum(direction_ * far, right_, p.right, up_, p.up), aMm);
      lines.stepMm = hn::Div(SetD(f_.stepVoxels), hn::Sqrt(Dot(lines.along, lines.along)));
      lines.eyeMm = hn::Neg(toEye);
      if (f_.localViewer)
        lines.towardsViewer =
            Scale(Sum(towardsCamera * far, -f_.axes.right, p.right, -f_.axes.up, p.up), aMm);
    }
    return lines;
  }

  HWY_INLINE Intervals InsideOf(int n, const D3& origin, const Lines& lines) const {
    const VD infinity = SetD(std::numeric_limits<double>::infinity());
    Intervals inside{lines.eyeMm, infinity, {}};
    constexpr double roundingVoxels = 1e-9;
    const auto cutAlong = [&](int a, VD o, VD slope) {
      const VD inverse = hn::Div(SetD(1), slope);
      Cut(hn::Sub(o, SetD(f_.high[a])), slope, inverse, roundingVoxels, inside);
      Cut(hn::Sub(SetD(f_.low[a]), o), hn::Neg(slope), hn::Neg(inverse), roundingVoxels, inside);
    };
    cutAlong(0, origin.x, lines.along.x);
    cutAlong(1, origin.y, lines.along.y);
    cutAlong(2, origin.z, lines.along.z);
    for (const ViewRays::Plane& p : f_.planes) {
      const D3 normal = Broadcast(p.normal);
      const VD slope = Dot(lines.along, normal);
      Cut(hn::Sub(Dot(origin, normal), SetD(p.offset)), slope, hn::Div(SetD(1), slope),
          roundingVoxels * f_.leastSpacingMm, inside);
    }
    if (parts_) {
      inside.t0 = hn::Max(inside.t0, hn::LoadU(DD(), parts_->from.data() + n));
      inside.t1 = hn::Min(inside.t1, hn::LoadU(DD(), parts_->to.data() + n));
    }
    const VD length = hn::Sub(inside.t1, inside.t0);
    inside.any = hn::And(hn::Gt(length, hn::Zero(DD())), hn::Lt(length, SetD(1e300)));
    return inside;
  }

  /// Keeps the part where outside + slope t <= 0. Lines that drift by less than `rounding` inside the volume
  /// count as parallel to the boundary. The boundary itself counts as inside to within `rounding` (picture.md
  /// 6), so that rounding errors do not decide.
  HWY_INLINE void Cut(VD outside, VD slope, VD inverse, double rounding, Intervals& inside) const {
    const VD never = SetD(-std::numeric_limits<double>::infinity());
    const VD drift = hn::Mul(slope, SetD(f_.lengthMm)), t = hn::Neg(hn::Mul(outside, inverse));
    const MD leaves = hn::Gt(drift, SetD(rounding)), enters = hn::Lt(drift, SetD(-rounding));
    const MD misses = hn::And(hn::Not(hn::Or(leaves, enters)), hn::Gt(outside, SetD(rounding)));
    inside.t1 = hn::IfThenElse(leaves, hn::Min(inside.t1, t), inside.t1);
    inside.t0 = hn::IfThenElse(enters, hn::Max(inside.t0, t), inside.t0);
    inside.t1 = hn::IfThenElse(misses, never, inside.t1);
  }

  HWY_INLINE void Write(int n, const D3& origin, const Lines& lines, const Intervals& inside) const {
    const VD one = SetD(1), t0 = hn::IfThenElseZero(inside.any, inside.t0);
    const VD length = hn::IfThenElseZero(inside.any, hn::Sub(inside.t1, inside.t0));
    const VD stepsAMm = hn::Div(one, lines.stepMm);
    // A remainder below a millionth of a step is rounding, not an interval of its own.
    const VD whole = hn::Ceil(hn::Sub(hn::Mul(length, stepsAMm), SetD(1e-6)));
    const VD before = hn::IfThenElse(inside.any, hn::Sub(hn::Max(one, whole), one), SetD(-1));
    const VD rest = hn::Sub(length, hn::Mul(before, lines.stepMm));
    const VD last = hn::IfThenElseZero(inside.any, hn::Max(rest, hn::Zero(DD())));
    const hn::Rebind<std::int32_t, DD> ints;
    hn::StoreU(hn::DemoteTo(ints, hn::Add(before, one)), ints, row_.steps.data() + n);
    const auto write = [&](VD v, std::vector<float>& to) {
      const hn::Rebind<float, DD> floats;
      hn::StoreU(hn::DemoteTo(floats, v), floats, to.data() + n);
    };
    const auto entered = [&](VD from, VD along) {
      return hn::IfThenElseZero(inside.any, hn::Add(from, hn::Mul(along, t0)));
    };
    write(entered(origin.x, lines.along.x), row_.startX);
    write(entered(origin.y, lines.along.y), row_.startY);
    write(entered(origin.z, lines.along.z), row_.startZ);
    write(hn::Mul(lines.along.x, lines.stepMm), row_.moveX);
    write(hn::Mul(lines.along.y, lines.stepMm), row_.moveY);
    write(hn::Mul(lines.along.z, lines.stepMm), row_.moveZ);
    write(lines.towardsViewer.x, row_.viewerX);
    write(lines.towardsViewer.y, row_.viewerY);
    write(lines.towardsViewer.z, row_.viewerZ);
    write(hn::Max(SetD(-1e30), hn::Min(hn::Mul(t0, stepsAMm), SetD(1e30))), row_.ahead);
    write(hn::Add(before, hn::Mul(hn::Mul(SetD(0.5), last), stepsAMm)), row_.lastMiddle);
    write(lines.stepMm, row_.stepMm);
    write(last, row_.lastStepMm);
  }

  const ViewRays& f_;
  const RayParts* parts_;
  RayRow& row_;
  glm::dvec3 target_, right_, up_, direction_;  ///< Voxel space per mm.
};

/// Converts RayRow::ahead from steps behind the picture to steps behind the first ray. Values are limited
/// where floats lose precision; any value is correct, it only spreads the rays.
void CountFromFirst(Ahead ahead, RayRow& row) {
  const DF df;
  constexpr float most = 1 << 20, none = std::numeric_limits<float>::max();
  const auto hasSteps = [&](std::size_t n) {
    return hn::RebindMask(df, hn::Gt(hn::LoadU(DI(), row.steps.data() + n), hn::Zero(DI())));
  };
  VF first = Set(none);
  for (std::size_t n = 0; n < row.ahead.size(); n += hn::Lanes(df))
    first = hn::Min(first, hn::IfThenElse(hasSteps(n), hn::LoadU(df, row.ahead.data() + n), Set(none)));
  first = hn::MinOfLanes(df, first);
  for (std::size_t n = 0; n < row.ahead.size(); n += hn::Lanes(df)) {
    const VF behind = hn::Min(hn::Sub(hn::LoadU(df, row.ahead.data() + n), first), Set(most));
    const VF counted =
        ahead == Ahead::whole ? hn::ConvertTo(df, Truncated(hn::Add(behind, Set(0.5f)))) : behind;
    hn::StoreU(hn::IfThenElseZero(hasSteps(n), counted), df, row.ahead.data() + n);
  }
}

void MakeRays(const ViewRays& f, Ahead ahead, const RayParts* parts, RayRow& row) {
  RayMaker(f, parts, row).Make();
  if (ahead == Ahead::none)
    std::fill(row.ahead.begin(), row.ahead.end(), 0.0f);
  else
    CountFromFirst(ahead, row);
}

GenerateRays ChooseRays() { return MakeRays; }

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseRays);
GenerateRays chooseGenerateRays() { return HWY_DYNAMIC_DISPATCH(ChooseRays)(); }

}  // namespace volumen
#endif  // HWY_ONCE
