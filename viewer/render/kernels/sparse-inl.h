// The composite kernel where few samples are visible, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_SPARSE_INL_H_
#endif

#include "viewer/render/kernels/dense-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

constexpr int kLanes = int(hn::MaxLanes(DF()));

/// Appends the chosen lanes to an array that has room for a whole vector behind `at`. Compressed in a
/// register and stored whole: compressing into memory is microcoded on some CPUs, many times slower.
HWY_INLINE void Append(VF v, MF which, float* at) { hn::StoreU(hn::Compress(v, which), DF(), at); }
HWY_INLINE void Append(VI v, MF which, std::int32_t* at) {
  hn::StoreU(hn::Compress(v, hn::RebindMask(DI(), which)), DI(), at);
}

/// Samples on their way, in the order of each ray's steps.
template <int kCapacity>
struct Samples {
  HWY_ALIGN float x[kCapacity], y[kCapacity], z[kCapacity], density[kCapacity];
  HWY_ALIGN float steps[kCapacity];   ///< length of the interval in steps
  HWY_ALIGN float units[kCapacity];   ///< length of the interval in unit distances
  HWY_ALIGN float weight[kCapacity];  ///< first its opacity, then what it adds to its ray
  HWY_ALIGN std::int32_t ray[kCapacity], segment[kCapacity];
  int size = 0;

  /// Makes what stands in the last vector behind the last sample harmless: places inside the volume.
  HWY_INLINE void Pad() {
    const DF df;
    for (float* values : {x, y, z, density, steps, units, weight})
      hn::StoreU(hn::Zero(df), df, values + size);
    for (std::int32_t* values : {ray, segment}) hn::StoreU(hn::Zero(DI()), DI(), values + size);
  }
};

/// In passes over many packets, so that no step waits for another and few branches are guessed wrong: where
/// to look; densities of what lies in visible blocks; opacities of what can be seen; weights, ray by ray;
/// gradient and light of what counts. Each pass works on whole vectors. Every sample is computed as
/// DenseTracer does, and added to its ray in the same order, so both give the same bytes.
template <class Store, ShadeBy kShade, bool kGradientOpacity, bool kRefined>
class SparseTracer {
  using Material = Matter<kShade, kGradientOpacity>;

 public:
  /// Adds to `out`, which must be 0.
  SparseTracer(const TraceFrame& f, const RayRow& rays, const PlaneBuffer&, const TraceRow& out,
               TraceCounts& counts)
      : f_(f),
        grid_(f),
        rays_(rays),
        matter_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        out_(out),
        counts_(counts),
        colour_(4 * rays.steps.size() + 4) {}

  /// Takes the packet at ray `first` through the steps [step, end) that `bits` names, step + n by bit n.
  HWY_INLINE void Advance(int first, int step, std::uint64_t bits) {
    if (!bits) return;
    const VF open = hn::LoadU(DF(), out_.alpha + first);
    const MF alive = hn::Le(open, Set(1 - f_.stopTransmittance));
    if (!AnyLeft(rays_, first, step, alive)) return;
    const Packet p = LoadPacket(f_, rays_, first);
    for (; bits; bits &= bits - 1) {
      const int at = step + int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      Look(p, first, at, hn::And(alive, HasStep(p, at)));
    }
    if (looked_.size > kLooked / 2) EndSlab();
  }

  void BeginSlab() {
    // What the slab's intervals are parted by must not depend on how far others of the slab have come.
    if constexpr (kRefined) alphaBefore_.assign(out_.alpha, out_.alpha + rays_.steps.size());
  }

  /// Draws all that was noted.
  void EndSlab() {
    if (looked_.size == 0) return;
    if constexpr (kRefined)
      Refine();
    else
      Draw(looked_);
    looked_.size = 0;
  }

  void Finish() {
    Shade();
    for (std::size_t n = 0; 4 * n + 4 < colour_.size(); ++n) {
      out_.red[n] = colour_[4 * n];
      out_.green[n] = colour_[4 * n + 1];
      out_.blue[n] = colour_[4 * n + 2];
    }
  }

 private:
  static constexpr int kLooked = 4096 + kLanes, kWaiting = 512;
  using Looked = Samples<kLooked>;

  HWY_INLINE void Look(const Packet& p, int first, int step, MF alive) {
    const MF last = IsLast(p, step);
    const int n = looked_.size;
    V3 place = Position(p, step, last);
    if constexpr (kRefined) {
      const VF before = Set(float(step)),
               middle = hn::IfThenElse(last, p.lastMiddle, Set(float(step) + 0.5f));
      const VF length = hn::Add(hn::Sub(middle, before), hn::Sub(middle, before));
      if (f_.parting.blocks) {
        const auto seen = [&](VF at) {
          return InVisibleBlock(*f_.parting.blocks, alive, grid_.Clamped(Add(p.start, Scale(p.move, at))));
        };
        alive = hn::Or(seen(before), seen(hn::Add(before, length)));
      }
      Append(length, alive, looked_.steps + n);
    } else {
      place = grid_.Clamped(place);
      if (f_.skip) alive = InVisibleBlock(*f_.skip, alive, place);
    }
    Append(place.x, alive, looked_.x + n);
    Append(place.y, alive, looked_.y + n);
    Append(place.z, alive, looked_.z + n);
    Append(hn::IfThenElse(last, p.lastUnits, p.units), alive, looked_.units + n);
    Append(hn::Iota(DI(), first), alive, looked_.ray + n);
    looked_.size += int(hn::CountTrue(DF(), alive));
  }

  HWY_INLINE void Draw(Looked& s) {
    Resample(s);
    Classify(s);
    Composite(s);
    KeepWhatCounts(s);
    s.size = 0;
  }

  static HWY_INLINE V3 PlaceOf(const Looked& s, int n) {
    const DF df;
    return {hn::Load(df, s.x + n), hn::Load(df, s.y + n), hn::Load(df, s.z + n)};
  }

  /// Into how many parts each interval is cut; 0: nothing of it can be seen.
  HWY_INLINE VI PartsOf(const Looked& s, int n) const {
    const DF df;
    const DI di;
    const Parting& parting = f_.parting;
    const Bounded b = Store::DensityWithBounds(grid_, grid_.CellAt(grid_.Clamped(PlaceOf(s, n))));
    const VF wider = hn::Mul(hn::Sub(b.high, b.low), Set(parting.widen));
    const VF low = hn::Sub(b.low, wider), high = hn::Add(b.high, wider);
    const CurveTable& t = *f_.curve;
    const VI first = SegmentOf(t, low), last = SegmentOf(t, high);
    const auto variation = [&](VI segment, VF density) {
      return OnSegment(t, t.variation, t.variationRise, segment, Along(t, segment, density));
    };
    const VF change = hn::Sub(variation(last, high), variation(first, low));
    const VF through = hn::Sub(Set(1), hn::GatherIndex(df, alphaBefore_.data(), hn::Load(di, s.ray + n)));
    const VF uneven = hn::Mul(hn::Mul(change, through), hn::Load(df, s.units + n));
    VI parts = SetI(1);
    for (int more = 1; more < parting.most; more *= 2) {
      const VF enough = Set(parting.tolerance * float(more) * float(more));
      parts = hn::IfThenElse(hn::RebindMask(di, hn::Gt(uneven, enough)), SetI(2 * more), parts);
    }
    const MF hidden = hn::And(hn::Eq(change, hn::Zero(df)), hn::Eq(OpacityOf(t, first, low), hn::Zero(df)));
    return hn::IfThenZeroElse(hn::RebindMask(di, hidden), parts);
  }

  /// Cuts the intervals that were noted and draws the parts.
  HWY_INLINE void Refine() {
    looked_.Pad();
    counts_.resampled += looked_.size;
    HWY_ALIGN std::int32_t parts[kLanes];
    for (int n = 0; n < looked_.size; n += kLanes) {
      hn::Store(PartsOf(looked_, n), DI(), parts);
      const int end = std::min(kLanes, looked_.size - n);
      for (int m = 0; m < end; ++m) Cut(n + m, parts[m]);
      if (parts_.size > kLooked - kLanes - (TraceFrame::mostParts + 1) * kLanes) Draw(parts_);
    }
    Draw(parts_);
  }

  /// Appends the parts of interval n, front to back.
  HWY_INLINE void Cut(int n, int count) {
    const DF df;
    const DI di;
    const RayRow& r = rays_;
    const int ray = looked_.ray[n];
    const float share = 1 / float(count | !count), length = looked_.steps[n] * share;
    const VF units = Set(looked_.units[n] * share);
    for (int part = 0; part < count; part += kLanes) {
      const VF along = hn::Mul(
          hn::Add(hn::ConvertTo(df, hn::Iota(di, part)), Set(0.5f - 0.5f * float(count))), Set(length));
      const V3 place = grid_.Clamped({hn::Add(Set(looked_.x[n]), hn::Mul(along, Set(r.moveX[ray]))),
                                      hn::Add(Set(looked_.y[n]), hn::Mul(along, Set(r.moveY[ray]))),
                                      hn::Add(Set(looked_.z[n]), hn::Mul(along, Set(r.moveZ[ray])))});
      const int at = parts_.size + part;
      hn::StoreU(place.x, df, parts_.x + at);
      hn::StoreU(place.y, df, parts_.y + at);
      hn::StoreU(place.z, df, parts_.z + at);
      hn::StoreU(units, df, parts_.units + at);
      hn::StoreU(SetI(ray), di, parts_.ray + at);
    }
    parts_.size += count;
  }

  /// Densities; keeps the samples that can be seen.
  HWY_INLINE void Resample(Looked& s) {
    const DF df;
    s.Pad();
    counts_.resampled += s.size;
    int kept = 0;
    for (int n = 0; n < s.size; n += kLanes) {
      const V3 place = PlaceOf(s, n);
      const VF units = hn::Load(df, s.units + n);
      const VI ray = hn::Load(DI(), s.ray + n);
      const VF density = Store::Density(grid_, grid_.CellAt(place));
      const MF seen = hn::And(matter_.CanBeSeen(density), hn::FirstN(df, std::size_t(s.size - n)));
      Append(place.x, seen, s.x + kept);
      Append(place.y, seen, s.y + kept);
      Append(place.z, seen, s.z + kept);
      Append(units, seen, s.units + kept);
      Append(ray, seen, s.ray + kept);
      Append(density, seen, s.density + kept);
      kept += int(hn::CountTrue(df, seen));
    }
    s.size = kept;
    s.Pad();
  }

  HWY_INLINE void Classify(Looked& s) {
    const DF df;
    for (int n = 0; n < s.size; n += kLanes) {
      const VF density = hn::Load(df, s.density + n);
      const VI segment = SegmentOf(*f_.curve, density);
      V3 stored = Zero3();
      if constexpr (kGradientOpacity) stored = GradientAt(s, n);
      hn::Store(segment, DI(), s.segment + n);
      const VF opacity = matter_.OpacityAt(segment, density, stored);
      hn::Store(IntervalOpacity(opacity, hn::Load(df, s.units + n)), df, s.weight + n);
    }
  }

  HWY_INLINE void Composite(Looked& s) {
    const float opaque = 1 - f_.stopTransmittance;
    for (int n = 0; n < s.size; ++n) {
      float& alpha = out_.alpha[s.ray[n]];
      const float weight = alpha <= opaque ? (1 - alpha) * s.weight[n] : 0.0f;
      s.weight[n] = weight;
      alpha += weight;
    }
  }

  /// Moves the samples of any weight to those that wait for light.
  HWY_INLINE void KeepWhatCounts(const Looked& s) {
    const DF df;
    const DI di;
    auto& w = waiting_;
    for (int n = 0; n < s.size; n += kLanes) {
      const VF weight = hn::Load(df, s.weight + n);
      const MF counts = hn::And(hn::Gt(weight, hn::Zero(df)), hn::FirstN(df, std::size_t(s.size - n)));
      if constexpr (kShade != ShadeBy::nothing) {
        Store::Prefetch(grid_,
                        grid_.CellAt({hn::Load(df, s.x + n), hn::Load(df, s.y + n), hn::Load(df, s.z + n)}),
                        std::min(kLanes, s.size - n));
        Append(hn::Load(df, s.x + n), counts, w.x + w.size);
        Append(hn::Load(df, s.y + n), counts, w.y + w.size);
        Append(hn::Load(df, s.z + n), counts, w.z + w.size);
      }
      Append(hn::Load(df, s.density + n), counts, w.density + w.size);
      Append(weight, counts, w.weight + w.size);
      Append(hn::Load(di, s.segment + n), counts, w.segment + w.size);
      Append(hn::Load(di, s.ray + n), counts, w.ray + w.size);
      w.size += int(hn::CountTrue(df, counts));
      if (w.size > kWaiting - 2 * kLanes) Shade();
    }
  }

  template <int kCapacity>
  HWY_INLINE V3 GradientAt(const Samples<kCapacity>& s, int n) const {
    const DF df;
    return Store::Gradient(
        grid_, grid_.CellAt({hn::Load(df, s.x + n), hn::Load(df, s.y + n), hn::Load(df, s.z + n)}));
  }

  /// Lights what waits and adds it to its rays, in order.
  HWY_NOINLINE void Shade() {
    auto& s = waiting_;
    if (s.size == 0) return;
    const std::int64_t begin = Ticks();
    s.Pad();
    const DF df;
    const DI di;
    HWY_ALIGN float added[4 * kLanes];
    for (int n = 0; n < s.size; n += kLanes) {
      V3 stored = Zero3();
      if constexpr (kShade != ShadeBy::nothing) stored = GradientAt(s, n);
      const V3 colour = matter_.ColourAt(hn::Load(di, s.segment + n), hn::Load(df, s.density + n), stored,
                                         hn::Load(di, s.ray + n));
      const V3 part = Scale(colour, hn::Load(df, s.weight + n));
      hn::StoreInterleaved4(part.x, part.y, part.z, hn::Zero(df), df, added);
      AddToRays(added, s.ray + n, std::min(kLanes, s.size - n));
    }
    counts_.composited += s.size;
    s.size = 0;
    counts_.shadeTicks += Ticks() - begin;
  }

  HWY_INLINE void AddToRays(const float* added, const std::int32_t* ray, int count) {
    const hn::CappedTag<float, 4> d4;
    for (int n = 0; n < count; ++n)
      for (int c = 0; c < 4; c += int(hn::MaxLanes(d4))) {
        float* sum = colour_.data() + 4 * ray[n] + c;
        hn::StoreU(hn::Add(hn::LoadU(d4, sum), hn::Load(d4, added + 4 * n + c)), d4, sum);
      }
  }

  const TraceFrame& f_;
  const Grid grid_;
  const RayRow& rays_;
  Material matter_;
  const TraceRow& out_;
  TraceCounts& counts_;
  std::vector<float> colour_;  ///< of each ray: red, green, blue, 0
  Looked looked_, parts_;
  std::vector<float> alphaBefore_;  ///< of each ray, where the slab begins
  Samples<kWaiting> waiting_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
