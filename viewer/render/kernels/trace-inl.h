// The composite kernels of one store, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#endif

#include <algorithm>

#include "viewer/render/kernels/packet-inl.h"
#include "viewer/render/kernels/sample-inl.h"
#include "viewer/render/kernels/shade-inl.h"
#include "viewer/render/kernels/table-inl.h"
#include "viewer/volume/bricks.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

#ifdef __x86_64__
HWY_INLINE std::int64_t Ticks() { return std::int64_t(__builtin_ia32_rdtsc()); }
#else
HWY_INLINE std::int64_t Ticks() { return 0; }
#endif

/// Visible samples wait here until there are enough to light whole vectors of them. In the order of the rays'
/// depth.
struct Queue {
  static constexpr int capacity = 128;
  HWY_ALIGN float x[capacity], y[capacity], z[capacity], density[capacity], weight[capacity];
  HWY_ALIGN std::int32_t segment[capacity], lane[capacity], step[capacity];
  int size = 0;
};

/// One kernel: rays of a row, a vector of neighbouring rays at a time.
template <class Store, ShadeBy kShade, bool kGradientOpacity>
class Tracer {
  static constexpr bool kPlane = std::is_void_v<Store>;
  static constexpr bool kGradients = kShade != ShadeBy::nothing || kGradientOpacity;

 public:
  Tracer(const TraceFrame& f, const RayRow& rays, const PlaneBuffer& plane, TraceCounts& counts)
      : f_(f), grid_(f), rays_(rays), plane_(plane), counts_(counts) {}

  HWY_INLINE void Packets(const TraceRow& out) {
    const int lanes = int(hn::Lanes(DF()));
    for (int first = 0; first < rays_.count; first += lanes) {
      first_ = first;
      for (float* c : {red_, green_, blue_}) std::fill_n(c, lanes, 0.0f);
      const VF alpha = Trace(LoadPacket(f_, rays_, first));
      std::copy_n(red_, lanes, out.red + first);
      std::copy_n(green_, lanes, out.green + first);
      std::copy_n(blue_, lanes, out.blue + first);
      hn::StoreU(alpha, DF(), out.alpha + first);
    }
  }

 private:
  HWY_INLINE VF Trace(const Packet& p) {
    const DF df;
    VF alpha = hn::Zero(df);
    const VF opaque = Set(1 - f_.stopTransmittance);
    for (int step = 0; step < p.longest;) {
      const MF alive = hn::And(HasStep(p, step), hn::Le(alpha, opaque));
      if (hn::AllFalse(df, alive)) break;
      const MF last = IsLast(p, step);
      const V3 position = Position(p, step, last);
      const V3 clamped = grid_.Clamped(position);
      MF looked = alive;
      if (f_.skip) {
        const VI distance = BlockDistance(clamped);
        looked = hn::AndNot(hn::RebindMask(df, hn::Gt(distance, SetI(0))), alive);
        if (hn::AllFalse(df, looked)) {
          step += Leap(p, alive, position, clamped, distance);
          continue;
        }
      }
      alpha = Composite(p, step, last, looked, clamped, alpha);
      ++step;
    }
    Flush();
    return alpha;
  }

  HWY_INLINE VI BlockDistance(const V3& clamped) const {
    const DI di;
    const auto block = [&](VF x) { return hn::ShiftRight<3>(hn::ConvertTo(di, x)); };
    static_assert(BrickRanges::edge == 8);
    const VI row = hn::Add(hn::Mul(block(clamped.z), SetI(f_.skip->count.y)), block(clamped.y));
    const VI index = hn::Add(hn::Mul(row, SetI(f_.skip->count.x)), block(clamped.x));
    const auto* base = reinterpret_cast<const std::int32_t*>(f_.skip->distance.data());
    return hn::And(hn::GatherOffset(di, base, index), SetI(255));
  }

  /// How many steps every living ray of the packet can take before it may meet a visible block: at least one.
  HWY_INLINE int Leap(const Packet& p, MF alive, const V3& position, const V3& clamped, VI distance) const {
    const DF df;
    const DI di;
    const VF free = hn::ConvertTo(df, hn::ShiftLeft<3>(hn::Sub(distance, SetI(1))));
    // A hundredth of a voxel within the free blocks, far more than positions are rounded by.
    const VF margin = Set(0.01f);
    const auto steps = [&](VF at, VF inside, VF inverse) {
      const VF low = hn::ConvertTo(df, hn::ShiftLeft<3>(hn::ShiftRight<3>(hn::ConvertTo(di, inside))));
      const VF ahead = hn::Sub(hn::Sub(hn::Add(hn::Add(low, Set(8)), free), margin), at);
      const VF behind = hn::Sub(hn::Add(hn::Sub(low, free), margin), at);
      return hn::Mul(hn::IfThenElse(hn::Ge(inverse, hn::Zero(df)), ahead, behind), inverse);
    };
    VF most = hn::Min(steps(position.x, clamped.x, p.inverse.x), steps(position.y, clamped.y, p.inverse.y));
    most = hn::Min(most, steps(position.z, clamped.z, p.inverse.z));
    most = hn::Min(hn::IfThenElse(alive, most, Set(1e6f)), Set(1e6f));
    return std::max(1, 1 + int(hn::GetLane(hn::MinOfLanes(df, most))));
  }

  HWY_INLINE VF DensityAt(const V3& clamped, int step) const {
    if constexpr (kPlane)
      return hn::LoadU(DF(), plane_.density + std::size_t(step) * plane_.stride + first_);
    else
      return Store::Density(grid_, grid_.CellAt(clamped));
  }

  /// The gradient of samples: at their positions, or of the plane at `step` and `lane`.
  HWY_INLINE V3 StoredGradient(const V3& clamped, VI step, VI lane) const {
    if constexpr (kPlane) {
      const DF df;
      const VI at =
          hn::ShiftLeft<2>(hn::Add(hn::Mul(step, SetI(plane_.stride)), hn::Add(lane, SetI(first_))));
      const float* g = plane_.gradients;
      return {hn::GatherIndex(df, g, at), hn::GatherIndex(df, g + 1, at), hn::GatherIndex(df, g + 2, at)};
    } else {
      return Store::Gradient(grid_, grid_.CellAt(clamped));
    }
  }

  /// One step of a packet: density, opacity, weight of each ray's sample; what counts goes to the queue.
  /// Returns the new alpha.
  HWY_INLINE VF Composite(const Packet& p, int step, MF last, MF looked, const V3& clamped, VF alpha) {
    const DF df;
    counts_.resampled += std::int64_t(hn::CountTrue(df, looked));
    const VF density = DensityAt(clamped, step);
    looked = hn::And(looked, hn::And(hn::Ge(density, Set(f_.curve->visibleLow)),
                                     hn::Le(density, Set(f_.curve->visibleHigh))));
    if (hn::AllFalse(df, looked)) return alpha;
    const VI segment = SegmentOf(*f_.curve, density);
    VF opacity = hn::IfThenElseZero(looked, OpacityOf(*f_.curve, segment, density));
    if (hn::AllTrue(df, hn::Eq(opacity, hn::Zero(df)))) return alpha;
    if constexpr (kGradientOpacity) {
      const V3 g = StoredGradient(clamped, SetI(step), hn::Iota(DI(), 0));
      opacity = hn::Mul(opacity, GradientFactor(*f_.transfer, NormalOf(f_, g).length));
    }
    const VF interval = IntervalOpacity(opacity, hn::IfThenElse(last, p.lastUnits, p.units));
    const VF weight = hn::Mul(hn::Sub(Set(1), alpha), interval);
    const MF counts = hn::Gt(weight, hn::Zero(df));
    Push(counts, clamped, density, weight, segment, step);
    return hn::Add(alpha, weight);
  }

  HWY_INLINE void Push(MF which, const V3& p, VF density, VF weight, VI segment, int step) {
    const DF df;
    const DI di;
    Queue& q = queue_;
    const auto whichInt = hn::RebindMask(di, which);
    const int n = q.size;
    // Compressed in a register and stored whole: compressing into memory is microcoded on some CPUs, many
    // times slower.
    const auto pushFloat = [&](VF v, float* to) { hn::StoreU(hn::Compress(v, which), df, to + n); };
    const auto pushInt = [&](VI v, std::int32_t* to) { hn::StoreU(hn::Compress(v, whichInt), di, to + n); };
    if constexpr (!kPlane && kGradients) {
      pushFloat(p.x, q.x);
      pushFloat(p.y, q.y);
      pushFloat(p.z, q.z);
    }
    pushFloat(density, q.density);
    pushFloat(weight, q.weight);
    pushInt(segment, q.segment);
    pushInt(hn::Iota(di, 0), q.lane);
    if constexpr (kPlane) hn::StoreU(SetI(step), di, q.step + n);
    q.size += int(hn::CountTrue(df, which));
    // A packet adds at most one vector; a vector more must still fit behind the last.
    if (q.size > Queue::capacity - 2 * int(hn::Lanes(df))) Flush();
  }

  /// Lights what waits in the queue and adds it to its rays, in order.
  HWY_NOINLINE void Flush() {
    Queue& q = queue_;
    if (q.size == 0) return;
    const std::int64_t begin = Ticks();
    const DF df;
    const DI di;
    const int lanes = int(hn::Lanes(df));
    // The rest of the last vector: harmless samples of no weight.
    for (int n = q.size; n % lanes; ++n) {
      q.x[n] = q.y[n] = q.z[n] = q.density[n] = q.weight[n] = 0;
      q.segment[n] = q.lane[n] = q.step[n] = 0;
    }
    HWY_ALIGN float red[HWY_MAX_BYTES / 4], green[HWY_MAX_BYTES / 4], blue[HWY_MAX_BYTES / 4];
    for (int n = 0; n < q.size; n += lanes) {
      const V3 position{hn::Load(df, q.x + n), hn::Load(df, q.y + n), hn::Load(df, q.z + n)};
      const VI lane = hn::Load(di, q.lane + n);
      V3 colour = ColourOf(*f_.curve, hn::Load(di, q.segment + n), hn::Load(df, q.density + n));
      if constexpr (kShade == ShadeBy::table)
        colour = ShadeByTable(*f_.table, StoredGradient(position, hn::Load(di, q.step + n), lane),
                              hn::Load(df, q.density + n));
      else if constexpr (kShade != ShadeBy::nothing)
        colour = Lit(colour, StoredGradient(position, hn::Load(di, q.step + n), lane), lane);
      const V3 added = Scale(colour, hn::Load(df, q.weight + n));
      hn::Store(added.x, df, red);
      hn::Store(added.y, df, green);
      hn::Store(added.z, df, blue);
      const int end = std::min(lanes, q.size - n);
      for (int m = 0; m < end; ++m) {
        const int ray = q.lane[n + m];
        red_[ray] += red[m];
        green_[ray] += green[m];
        blue_[ray] += blue[m];
      }
    }
    counts_.composited += q.size;
    q.size = 0;
    counts_.shadeTicks += Ticks() - begin;
  }

  HWY_INLINE V3 Lit(const V3& colour, const V3& stored, VI lane) const {
    const Normal normal = NormalOf(f_, stored);
    DS shade;
    if constexpr (kShade == ShadeBy::map) {
      shade = ShadeMap(*f_.map, normal.n);
    } else if constexpr (kShade == ShadeBy::mapNearest) {
      shade = ShadeMapNearest(*f_.map, normal.n);
    } else if constexpr (kShade == ShadeBy::phong) {
      shade = ShadePhong<false>(*f_.lighting, normal.n, Broadcast(f_.lighting->viewer));
    } else {
      const DF df;
      const auto ofRay = [&](const std::vector<float>& v) {
        return hn::GatherIndex(df, v.data() + first_, lane);
      };
      shade = ShadePhong<true>(*f_.lighting, normal.n,
                               {ofRay(rays_.viewerX), ofRay(rays_.viewerY), ofRay(rays_.viewerZ)});
    }
    const DS floored = WithFloor(f_, shade, normal.length);
    return Add(
        {hn::Mul(colour.x, floored.d.x), hn::Mul(colour.y, floored.d.y), hn::Mul(colour.z, floored.d.z)},
        floored.s);
  }

  const TraceFrame& f_;
  const Grid grid_;
  const RayRow& rays_;
  const PlaneBuffer& plane_;
  TraceCounts& counts_;
  int first_ = 0;
  HWY_ALIGN float red_[HWY_MAX_BYTES / 4], green_[HWY_MAX_BYTES / 4], blue_[HWY_MAX_BYTES / 4];
  Queue queue_;
};

template <class Store, ShadeBy kShade, bool kGradientOpacity>
void TraceRays(const TraceFrame& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
               TraceCounts& counts) {
  const std::int64_t begin = Ticks();
  Tracer<Store, kShade, kGradientOpacity>(f, rays, plane, counts).Packets(out);
  counts.allTicks += Ticks() - begin;
}

template <class Store>
TraceKernel ChooseShade(TraceKey key) {
  switch (key.shade) {
    case ShadeBy::map:
      return key.gradientOpacity ? TraceRays<Store, ShadeBy::map, true>
                                 : TraceRays<Store, ShadeBy::map, false>;
    case ShadeBy::mapNearest:
      return key.gradientOpacity ? TraceRays<Store, ShadeBy::mapNearest, true>
                                 : TraceRays<Store, ShadeBy::mapNearest, false>;
    case ShadeBy::table:
      return key.gradientOpacity ? TraceRays<Store, ShadeBy::table, true>
                                 : TraceRays<Store, ShadeBy::table, false>;
    case ShadeBy::phong:
      return key.gradientOpacity ? TraceRays<Store, ShadeBy::phong, true>
                                 : TraceRays<Store, ShadeBy::phong, false>;
    case ShadeBy::local:
      return key.gradientOpacity ? TraceRays<Store, ShadeBy::local, true>
                                 : TraceRays<Store, ShadeBy::local, false>;
    case ShadeBy::nothing:
      break;
  }
  return key.gradientOpacity ? TraceRays<Store, ShadeBy::nothing, true>
                             : TraceRays<Store, ShadeBy::nothing, false>;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
