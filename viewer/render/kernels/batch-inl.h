// The composite kernel of plain steps that looks only at samples whose cells can show anything, compiled once
// a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_BATCH_INL_H_
#undef VOLUMEN_RENDER_KERNELS_BATCH_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_BATCH_INL_H_
#endif

#include <cstring>
#include <utility>

#include "viewer/render/kernels/cells-inl.h"
#include "viewer/render/kernels/sample_arrays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Samples in visible cells, of some packets, side by side whichever rays they belong to: density and
/// gradient together, opacities, light; then over one another, each on its ray. While one batch is worked on
/// the memory of the next is on its way. Every sample is computed as DenseTracer does, and added to its ray
/// in the same order, so both give the same bytes.
template <class Store, ShadeBy kShade, bool kGradientOpacity>
class BatchTracer {
  using Material = Matter<kShade, kGradientOpacity>;

 public:
  static constexpr int kSlab = 16;  ///< steps that all packets take before any goes on
  static constexpr bool kCells = true;
  static constexpr bool kPrefetches = false;
  static constexpr bool kBlends = false;

  /// Adds to `out`, which must be 0.
  BatchTracer(const TraceFrame& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
              TraceCounts& counts)
      : f_(f),
        grid_(f, Material::kGradients ? f.gradientRow : f.densityRow),
        rays_(rays),
        matter_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        out_(out),
        counts_(counts) {}

  /// Takes the packet at ray `first`, which is open, through the steps that `bits` names, step + n by bit n.
  HWY_INLINE void Advance(const Skipper& skipper, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    Place(LoadPacket(f_, rays_, first), Windows(*f_.cells, skipper, step), first, step, bits);
    if (next_->size < kFull) return;
    std::swap(next_, batch_);
    Draw(*next_);
  }
  void BeginSlab() {}
  void EndSlab() {
    Draw(*batch_);
    Draw(*next_);
  }
  void Finish() {}

 private:
  static constexpr int kFull = 8 * kLanes;
  using Windows = CellWindows<kSlab>;

  static constexpr bool kRays = kShade == ShadeBy::local;  ///< whether light asks which ray a sample is of

  static constexpr int kMost = kFull + (kSlab + 1) * kLanes, kMostSteps = kFull + kSlab;
  /// Samples, and the steps of packets that they are of.
  struct Batch : SampleArrays<kMost> {
    HWY_ALIGN std::int32_t ray[kRays ? kMost : 1];
    struct Step {
      int first;             ///< ray of the packet
      std::uint8_t mask[8];  ///< which of its rays have a sample here
    };
    Step steps[kMostSteps];
    int stepCount = 0;

    /// Fills the last vector with samples of length 0.
    HWY_INLINE void Pad() {
      const int end = this->size;
      for (float* values : {this->x, this->y, this->z, this->units})
        hn::StoreU(hn::Zero(DF()), DF(), values + end);
      hn::StoreU(hn::Zero(DI()), DI(), this->index + end);
      if constexpr (kRays) hn::StoreU(hn::Zero(DI()), DI(), ray + end);
    }
  };

  /// Notes the packet's samples in visible cells, and asks for their voxels.
  HWY_INLINE void Place(const Packet& p, const Windows& windows, int first, int step, std::uint64_t bits) {
    const DF df;
    auto& s = *next_;
    const MF open = hn::Le(hn::LoadU(df, out_.alpha + first), Set(1 - f_.stopTransmittance));
    // All steps are asked before any is noted, so that none waits for what the one before has found.
    std::uint8_t masks[kSlab][8];
    std::uint64_t visible = 0;
    for (; bits; bits &= bits - 1) {
      const int k = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      const VF n = SampleAt(p, step + k);
      const V3 place = Position(p, n, IsLast(p, n));
      const MF there = hn::And(open, HasSample(p, n));
      const MF has = windows.fits(k) ? windows.IsVisible(k, there, place)
                                     : InVisibleCell(*f_.cells, there, grid_.Clamped(place));
      hn::StoreMaskBits(df, has, masks[k]);
      visible |= std::uint64_t(!hn::AllFalse(df, has)) << k;
    }
    for (; visible; visible &= visible - 1) {
      const int k = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(visible));
      const VF n = SampleAt(p, step + k);
      const MF last = IsLast(p, n), has = hn::LoadMaskBits(df, masks[k]);
      auto& noted = s.steps[s.stepCount++];
      noted.first = first;
      std::memcpy(noted.mask, masks[k], sizeof(noted.mask));
      const Cell c = grid_.CellAt(grid_.Clamped(Position(p, n, last)));
      Append(hn::IfThenElse(last, p.lastUnits, p.units), has, s.units + s.size);
      Append(c.index, has, s.index + s.size);
      Append(c.fx, has, s.x + s.size);
      Append(c.fy, has, s.y + s.size);
      Append(c.fz, has, s.z + s.size);
      if constexpr (kRays) Append(hn::Iota(DI(), first), has, s.ray + s.size);
      const int count = int(hn::CountTrue(df, has));
      // The cells between are their neighbours, mostly in the same lines of the cache.
      Store::template Prefetch<Material::kGradients>(grid_, s.index + s.size, count, 2);
      s.size += count;
    }
  }

  HWY_INLINE void Draw(Batch& s) {
    if (s.size == 0) return;
    counts_.resampled += s.size;
    s.Pad();
    Resample(s);
    Classify(matter_, s);
    // One batch in 32 is timed; they stand for all.
    const std::int64_t begin = timed_++ % 32 == 0 ? Ticks() : 0;
    Light(matter_, s, [&](int n) {
      if constexpr (kRays)
        return hn::Load(DI(), s.ray + n);
      else
        return hn::Zero(DI());
    });
    Composite(s);
    if (begin) counts_.shadeTicks += 32 * (Ticks() - begin);
    s.size = s.stepCount = 0;
  }

  /// Densities and gradients; nothing is left of the length of samples that cannot be seen.
  HWY_INLINE void Resample(Batch& s) {
    const DF df;
    for (int n = 0; n < s.size; n += kLanes) {
      const V3 place = PlaceOf(s, n);
      const Cell c{hn::Load(DI(), s.index + n), place.x, place.y, place.z};
      Sample x;
      if constexpr (Material::kGradients)
        x = Store::DensityAndGradient(grid_, c);
      else
        x = {Store::Density(grid_, c), Zero3()};
      hn::Store(hn::IfThenElseZero(matter_.CanBeSeen(x.density), hn::Load(df, s.units + n)), df, s.units + n);
      hn::Store(x.density, df, s.density + n);
      hn::Store(x.gradient.x, df, s.x + n);
      hn::Store(x.gradient.y, df, s.y + n);
      hn::Store(x.gradient.z, df, s.z + n);
    }
  }

  /// Front to back (paper 3.1).
  HWY_INLINE void Composite(Batch& s) {
    const DF df;
    const VF opaque = Set(1 - f_.stopTransmittance);
    int at = 0;
    for (int k = 0; k < s.stepCount;) {
      const int first = s.steps[k].first;
      VF red = hn::LoadU(df, out_.red + first), green = hn::LoadU(df, out_.green + first),
         blue = hn::LoadU(df, out_.blue + first), alpha = hn::LoadU(df, out_.alpha + first);
      for (; k < s.stepCount && s.steps[k].first == first; ++k) {
        const MF has = hn::LoadMaskBits(df, s.steps[k].mask);
        const auto expanded = [&](const float* v) { return Expanded(hn::LoadU(df, v + at), has); };
        const VF opacity = hn::IfThenElseZero(hn::Le(alpha, opaque), expanded(s.units));
        const VF weight = hn::Mul(hn::Sub(Set(1), alpha), opacity);
        red = hn::Add(red, hn::Mul(expanded(s.x), weight));
        green = hn::Add(green, hn::Mul(expanded(s.y), weight));
        blue = hn::Add(blue, hn::Mul(expanded(s.z), weight));
        alpha = hn::Add(alpha, weight);
        counts_.composited += std::int64_t(hn::CountTrue(df, hn::Gt(weight, hn::Zero(df))));
        at += int(hn::CountTrue(df, has));
      }
      hn::StoreU(red, df, out_.red + first);
      hn::StoreU(green, df, out_.green + first);
      hn::StoreU(blue, df, out_.blue + first);
      hn::StoreU(alpha, df, out_.alpha + first);
    }
  }

  const TraceFrame& f_;
  const Grid grid_;
  const RayRow& rays_;
  Material matter_;
  const TraceRow& out_;
  TraceCounts& counts_;
  Batch batches_[2];
  Batch *batch_ = &batches_[0], *next_ = &batches_[1];
  unsigned timed_ = 0;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
