// Composite kernel for plain steps that fetches density and gradient together. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_DENSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_DENSE_INL_H_
#undef VOLUMEN_KERNELS_DENSE_INL_H_
#else
#define VOLUMEN_KERNELS_DENSE_INL_H_
#endif

#include "viewer/kernels/empty_space-inl.h"
#include "viewer/kernels/sample_arrays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Composites whole packets, one group of steps at a time. Passes over a group: positions, density and
/// gradient together, opacities, light, compositing. Each pass is short, so that many samples are in flight
/// at once.
template <class Store, bool kIsLit, bool kGradientOpacity>
class DenseTracer {
  static constexpr bool kPlane = std::is_void_v<Store>;
  using Material = ClassifyAndLight<kIsLit, kGradientOpacity>;

 public:
  /// Steps that all packets take before any packet takes the next group.
  static constexpr int kGroupSteps = 8;
  static constexpr bool kCells = false;  ///< True if single rays are tested against VisibleCells.
  static constexpr bool kPrefetches = !kPlane;
  static constexpr bool kBlends = true;  ///< Slices can also be blended back to front.
  /// Tracer without light; it computes the same opacities.
  using Unlit = DenseTracer<Store, false, kGradientOpacity>;

  /// `out` must be 0; the results are added to it. Groups come in the order of the picture's slices.
  DenseTracer(const RayInputs& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
              TraceCounts& counts)
      : f_(f),
        grid_(Material::kGradients ? Grid::OfGradients(f) : Grid(f, f.densityRow)),
        rays_(rays),
        material_{f, rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
        plane_(plane),
        out_(out),
        counts_(counts) {}

  /// Prefetches the voxels of samples between `low` and `high` (voxel positions inside the grid).
  HWY_INLINE void Prefetch(glm::vec3 low, glm::vec3 high) const {
    Store::template PrefetchBox<Material::kGradients>(grid_, low, high);
  }

  /// Advances the open packet at ray `first` through the steps that `bits` names: bit n stands for `step` +
  /// n.
  HWY_INLINE void Advance(const EmptySpaceSkipper&, int first, int step, std::uint64_t bits) {
    if (!bits) return;
    material_.first = first;
    const Packet p = LoadPacket(f_, rays_, first);
    if (!cuts() && GoOn(p, hn::FirstN(DF(), kLanes), step, kGroupSteps))
      Place<true>(p, step, bits);
    else
      Place<false>(p, step, bits);
    Resample();
    Classify(material_, samples_);
    if (samples_.size == 0) return;
    // Times one group of steps in 32 and extrapolates to all.
    const std::int64_t begin = timed_++ % 32 == 0 ? Ticks() : 0;
    Light(material_, samples_, [](int) { return hn::Iota(DI(), 0); });
    if (f_.slices.fromBack)
      Blend();
    else
      Composite();
    if (begin) counts_.shadeTicks += 32 * (Ticks() - begin);
  }
  void BeginGroup() {}
  void EndGroup() {}
  void Finish() {}

 private:
  /// Returns true if rays end at their last step that shows (TraceRow::shown).
  bool cuts() const { return f_.slices.fromBack && out_.shown; }

  /// Finds the positions of the packet's samples at these steps. `kGoOn`: GoOn holds for all rays and no ray
  /// is cut.
  template <bool kGoOn>
  HWY_INLINE void Place(const Packet& p, int step, std::uint64_t bits) {
    const DF df;
    auto& s = samples_;
    const VF shown =
        cuts() ? hn::LoadU(df, out_.shown + material_.first) : Set(std::numeric_limits<float>::max());
    const bool notesSteps = kPlane || out_.shown;
    int size = 0;
    for (; bits; bits &= bits - 1, size += kLanes) {
      const int at = step + int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      const VF n = SampleAt(p, at);
      V3 place;
      if constexpr (kGoOn) {
        place = PositionBefore(p, n);
        hn::Store(p.unitDistances, df, s.unitDistances + size);
        counts_.resampled += kLanes;
      } else {
        const MF last = IsLast(p, n), has = hn::And(HasSample(p, n), hn::Le(Set(float(at)), shown));
        place = Position(p, n, last);
        hn::Store(hn::IfThenElseZero(has, hn::IfThenElse(last, p.lastUnitDistances, p.unitDistances)), df,
                  s.unitDistances + size);
        counts_.resampled += std::int64_t(hn::CountTrue(df, has));
      }
      if (notesSteps) s.step[size / kLanes] = at;
      if constexpr (!kPlane) {
        const Cell c = grid_.CellAt(grid_.Clamped(place));
        hn::Store(c.index, DI(), s.index + size);
        hn::Store(c.fx, df, s.x + size);
        hn::Store(c.fy, df, s.y + size);
        hn::Store(c.fz, df, s.z + size);
      }
    }
    s.size = size;
  }

  HWY_INLINE Sample ValuesAt(int n) const {
    const DF df;
    const auto& s = samples_;
    if constexpr (kPlane) {
      const std::size_t at = std::size_t(s.step[n / kLanes]) * plane_.stride + material_.first;
      Sample x{hn::LoadU(df, plane_.density + at), Zero3()};
      VF none;
      if constexpr (Material::kGradients)
        hn::LoadInterleaved4(df, plane_.gradients + 4 * at, x.gradient.x, x.gradient.y, x.gradient.z, none);
      return x;
    } else {
      const V3 place = PlaceOf(s, n);
      const Cell c{hn::Load(DI(), s.index + n), place.x, place.y, place.z};
      if constexpr (Material::kGradients)
        return Store::DensityAndGradient(grid_, c);
      else
        return {Store::Density(grid_, c), Zero3()};
    }
  }

  /// Computes densities and gradients; keeps only the steps at which a sample can be seen.
  HWY_INLINE void Resample() {
    const DF df;
    auto& s = samples_;
    const bool notesSteps = out_.shown;
    int kept = 0;
    for (int n = 0; n < s.size; n += kLanes) {
      const VF unitDistances = hn::Load(df, s.unitDistances + n);
      const Sample x = ValuesAt(n);
      const MF seen = hn::And(hn::Gt(unitDistances, hn::Zero(df)), material_.CanBeSeen(x.density));
      if (hn::AllFalse(df, seen)) continue;
      hn::Store(x.density, df, s.density + kept);
      if constexpr (Material::kGradients) {
        // Overwrites positions, which are no longer needed.
        hn::Store(x.gradient.x, df, s.x + kept);
        hn::Store(x.gradient.y, df, s.y + kept);
        hn::Store(x.gradient.z, df, s.z + kept);
      }
      hn::Store(hn::IfThenElseZero(seen, unitDistances), df, s.unitDistances + kept);
      if (notesSteps) s.step[kept / kLanes] = s.step[n / kLanes];
      kept += kLanes;
    }
    s.size = kept;
  }

  /// The sums of the packet's rays so far.
  struct Pixels {
    V3 colour;
    VF alpha;
  };
  HWY_INLINE Pixels PixelsSoFar() const {
    const auto load = [&](const float* values) { return hn::LoadU(DF(), values + material_.first); };
    return {{load(out_.red), load(out_.green), load(out_.blue)}, load(out_.alpha)};
  }
  HWY_INLINE void Keep(const Pixels& p) const {
    const auto store = [&](VF v, float* values) { hn::StoreU(v, DF(), values + material_.first); };
    store(p.colour.x, out_.red), store(p.colour.y, out_.green), store(p.colour.z, out_.blue);
    store(p.alpha, out_.alpha);
  }

  /// Composites front to back (paper 3.1).
  HWY_INLINE void Composite() {
    const auto& s = samples_;
    const DF df;
    const VF opaque = Set(1 - f_.stopTransmittance);
    Pixels p = PixelsSoFar();
    for (int n = 0; n < s.size; n += kLanes) {
      const VF opacity = hn::IfThenElseZero(hn::Le(p.alpha, opaque), hn::Load(df, s.unitDistances + n));
      const VF weight = hn::Mul(hn::Sub(Set(1), p.alpha), opacity);
      p.colour = Add(p.colour, Scale(PlaceOf(s, n), weight));
      p.alpha = hn::Add(p.alpha, weight);
      const MF counts = hn::Gt(weight, hn::Zero(df));
      counts_.composited += std::int64_t(hn::CountTrue(df, counts));
      if constexpr (!Material::kLit)
        if (out_.shown) {
          float* shown = out_.shown + material_.first;
          hn::StoreU(hn::IfThenElse(counts, Set(float(s.step[n / kLanes])), hn::LoadU(df, shown)), df, shown);
        }
    }
    Keep(p);
  }

  /// Blends slices over what lies behind them, back to front (paper 3.2).
  HWY_INLINE void Blend() {
    const auto& s = samples_;
    const DF df;
    Pixels p = PixelsSoFar();
    for (int n = s.size - kLanes; n >= 0; n -= kLanes) {
      const VF alpha = hn::Load(df, s.unitDistances + n), through = hn::Sub(Set(1), alpha);
      const V3 colour = Scale(PlaceOf(s, n), alpha);
      p.colour = {InBuffer(colour.x, hn::Mul(through, p.colour.x)),
                  InBuffer(colour.y, hn::Mul(through, p.colour.y)),
                  InBuffer(colour.z, hn::Mul(through, p.colour.z))};
      p.alpha = InBuffer(alpha, hn::Mul(through, p.alpha));
      counts_.composited += std::int64_t(hn::CountTrue(df, hn::Gt(alpha, hn::Zero(df))));
    }
    Keep(p);
  }

  /// Returns a component of the frame buffer: `front` plus what shows through from behind.
  HWY_INLINE VF InBuffer(VF front, VF behind) const {
    if (f_.slices.levels == 0) return hn::Add(front, behind);
    const VF one = Set(1), sum = hn::Min(hn::Add(hn::Min(front, one), behind), one);
    const VF levels = Set(f_.slices.levels);
    const VI whole = Truncated(hn::Add(hn::Mul(sum, levels), Set(0.5f)));
    return hn::Div(hn::ConvertTo(DF(), whole), levels);
  }

  /// The samples of a packet in one group of steps, one vector per step.
  struct StepGroup : SampleArrays<kGroupSteps * kLanes> {
    int step[kGroupSteps];
  };

  const RayInputs& f_;
  const Grid grid_;
  const RayRow& rays_;
  Material material_;
  const PlaneBuffer& plane_;
  const TraceRow& out_;
  TraceCounts& counts_;
  StepGroup samples_;
  unsigned timed_ = 0;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
