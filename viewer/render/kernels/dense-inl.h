// The composite kernel where most samples are visible, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_DENSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_DENSE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_DENSE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_DENSE_INL_H_
#endif

#include "viewer/render/kernels/matter-inl.h"
#include "viewer/render/kernels/skip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Density and gradient together, one step of the whole packet at a time, everything in registers.
template <class Store, ShadeBy kShade, bool kGradientOpacity>
class DenseTracer {
  static constexpr bool kPlane = std::is_void_v<Store>;
  using Material = Matter<kShade, kGradientOpacity>;
  struct Sum {
    V3 colour;
    VF alpha;
  };

 public:
  static constexpr int kSlab = 8;        ///< steps that all packets take before any goes on
  static constexpr bool kCells = false;  ///< whether single rays ask VisibleCells

  /// Adds to `out`, which must be 0.
  DenseTracer(const TraceFrame& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
              TraceCounts& counts)
      : f_(f),
        grid_(f),
        rays_(rays),
        matter_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        plane_(plane),
        out_(out),
        counts_(counts) {}

  /// Takes the packet at ray `first`, which is open, through the steps [step, end) that `bits` names, step +
  /// n by bit n.
  HWY_INLINE void Advance(int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const DF df;
    const auto load = [&](const float* values) { return hn::LoadU(df, values + first); };
    const VF opaque = Set(1 - f_.stopTransmittance);
    Sum sum{Zero3(), load(out_.alpha)};
    matter_.first = first;
    sum.colour = {load(out_.red), load(out_.green), load(out_.blue)};
    const Packet p = LoadPacket(f_, rays_, first);
    for (; bits; bits &= bits - 1) {
      const int at = step + int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      const MF alive = hn::And(HasSample(p, SampleAt(p, at)), hn::Le(sum.alpha, opaque));
      if (hn::AllFalse(df, alive)) continue;
      Composite(p, at, alive, sum);
    }
    hn::StoreU(sum.colour.x, df, out_.red + first);
    hn::StoreU(sum.colour.y, df, out_.green + first);
    hn::StoreU(sum.colour.z, df, out_.blue + first);
    hn::StoreU(sum.alpha, df, out_.alpha + first);
  }
  void BeginSlab() {}
  void EndSlab() {}
  void Finish() {}

 private:
  HWY_INLINE Sample ValuesAt(const V3& clamped, int step) const {
    if constexpr (kPlane) {
      const DF df;
      const std::size_t at = std::size_t(step) * plane_.stride + matter_.first;
      Sample s{hn::LoadU(df, plane_.density + at), Zero3()};
      VF none;
      if constexpr (Material::kGradients)
        hn::LoadInterleaved4(df, plane_.gradients + 4 * at, s.gradient.x, s.gradient.y, s.gradient.z, none);
      return s;
    } else if constexpr (Material::kGradients) {
      return Store::DensityAndGradient(grid_, grid_.CellAt(clamped));
    } else {
      return {Store::Density(grid_, grid_.CellAt(clamped)), Zero3()};
    }
  }

  HWY_INLINE void Composite(const Packet& p, int step, MF alive, Sum& sum) {
    const DF df;
    const VF n = SampleAt(p, step);
    const MF last = IsLast(p, n);
    const V3 clamped = grid_.Clamped(Position(p, n, last));
    counts_.resampled += std::int64_t(hn::CountTrue(df, alive));
    const Sample s = ValuesAt(clamped, step);
    const MF seen = hn::And(alive, matter_.CanBeSeen(s.density));
    if (hn::AllFalse(df, seen)) return;
    // One step in 32 is timed; its two parts stand for all.
    const std::int64_t begin = step % 32 == 0 ? Ticks() : 0;
    const VI segment = SegmentOf(*f_.curve, s.density);
    const VF opacity = hn::IfThenElseZero(seen, matter_.OpacityAt(segment, s.density, s.gradient));
    const VF interval = IntervalOpacity(opacity, hn::IfThenElse(last, p.lastUnits, p.units));
    const VF weight = hn::Mul(hn::Sub(Set(1), sum.alpha), interval);
    const V3 colour = matter_.ColourAt(segment, s.density, s.gradient, hn::Iota(DI(), 0));
    sum.colour = Add(sum.colour, Scale(colour, weight));
    sum.alpha = hn::Add(sum.alpha, weight);
    counts_.composited += std::int64_t(hn::CountTrue(df, hn::Gt(weight, hn::Zero(df))));
    if (begin) counts_.shadeTicks += 32 * (Ticks() - begin);
  }

  const TraceFrame& f_;
  const Grid grid_;
  const RayRow& rays_;
  Material matter_;
  const PlaneBuffer& plane_;
  const TraceRow& out_;
  TraceCounts& counts_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
