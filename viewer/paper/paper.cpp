#include "viewer/paper/paper.h"

#include <glm/geometric.hpp>

#include "viewer/evaluation/statistics.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Returns the step, in voxels, with which a ray along the camera's axis has `samples` samples in the volume
// (picture.md 9). For 0 samples: one per voxel.
double stepFor(const Scene& scene, const VoxelGeometry& geometry, int samples) {
  if (samples == 0) return 1;
  const glm::dvec3 axis =
      geometry.voxelFromPatientStep() * cameraAxes(scene.camera.value_or(Camera{})).direction;
  const glm::dvec3 along = glm::abs(axis) / glm::length(axis);
  return glm::dot(along, glm::dvec3(geometry.size)) / samples;
}

// One figure: a plan that is drawn once per round.
struct Timed {
  Plan plan;
  std::vector<double> ms;
};

class PaperMeasurement {
 public:
  PaperMeasurement(const PaperOptions& options, const StudyProgress& progress, const CancelToken& cancel)
      : options_(options), progress_(progress), cancel_(cancel) {}

  Status tables(PaperBench& bench) {
    for (int n = 0; n < int(bench.volumes.size()); ++n) {
      const PaperVolume& v = bench.volumes[n];
      RenderCaches caches(v.volume);
      std::vector<Timed> timed;
      for (const Method method : {Method::planes, Method::blend})
        for (const PaperPicture& p : paperPictures)
          if (Status s = add(timed, v.scene, caches, p, method, options_.threads); !s) return s;
      if (Status s = drawAll(timed, caches, ("tables: " + v.name).c_str()); !s) return s;
      for (int k = 0; k < int(timed.size()); ++k)
        bench.cells.push_back({timed[k].plan.method, k % int(paperPictures.size()), n, median(timed[k].ms),
                               minimum(timed[k].ms)});
    }
    bench.kernel = kernel_;
    return {};
  }

  Status threads(PaperBench& bench) {
    for (int n = 0; n < int(bench.volumes.size()); ++n) {
      RenderCaches caches(bench.volumes[n].volume);
      std::vector<Timed> timed;
      for (int t = 1; t <= allowedThreads(); ++t)
        if (Status s = add(timed, bench.volumes[n].scene, caches, paperPictures[0], Method::planes, t); !s)
          return s;
      if (Status s = drawAll(timed, caches, "threads"); !s) return s;
      for (int t = 1; t <= int(timed.size()); ++t)
        bench.threads.push_back({n, t, median(timed[std::size_t(t) - 1].ms)});
    }
    return {};
  }

  Status sizes(PaperBench& bench) {
    for (const int edge : {32, 64, 128, 256}) {
      RenderCaches caches(*makePhantom("opaque-sphere:" + std::to_string(edge)));
      // Voxels of 1 mm; the paper's sphere has 64. Each sample thus has the same opacity in every size.
      Scene scene = bench.volumes[2].scene;
      scene.transferFunction.unitDistance *= edge / 64.0;
      std::vector<Timed> timed;
      if (Status s = add(timed, scene, caches, {100, 100}, Method::planes, options_.threads); !s) return s;
      if (Status s = drawAll(timed, caches, "sizes of the opaque sphere"); !s) return s;
      bench.sizes.push_back({edge, median(timed[0].ms)});
    }
    return {};
  }

 private:
  Status add(std::vector<Timed>& timed, const Scene& scene, RenderCaches& caches, const PaperPicture& picture,
             Method method, int threads) {
    RenderOptions o;
    o.size = {picture.width, picture.width};
    o.method = method;
    o.threads = threads;
    o.step = stepFor(scene, caches.volume()->geometry(), picture.samples);
    auto plan = makePlan(scene, caches.facts(), o);
    if (!plan) return plan.error();
    timed.push_back({std::move(*plan), {}});
    return {};
  }

  // The first round warms up and fills the caches.
  Status drawAll(std::vector<Timed>& timed, RenderCaches& caches, const char* what) {
    for (int round = 0; round <= options_.rounds; ++round)
      for (Timed& t : timed) {
        if (progress_) progress_(what, std::size_t(round), std::size_t(options_.rounds) + 1);
        const double begin = wallMs();
        const auto done = render(t.plan, caches, cancel_);
        if (!done) return done.error();
        if (round > 0) t.ms.push_back(wallMs() - begin);
        kernel_ = done->stats.kernel;
      }
    return {};
  }

  const PaperOptions& options_;
  const StudyProgress& progress_;
  const CancelToken& cancel_;
  std::string kernel_;
};

// A method of section 4: how it changes the scene, and how it draws it.
struct Rival {
  const char *name, *what;
  void (*see)(Scene&);
  void (*draw)(RenderOptions&);
};

const std::vector<Rival>& rivals() {
  static const std::vector<Rival> all{
      {"Planes", "algorithm 1: shaded after interpolation, front to back", [](Scene&) {},
       [](RenderOptions&) {}},
      {"Blend", "algorithm 2: the same, slices from back to front, 8 bits a component", [](Scene&) {},
       [](RenderOptions& o) {
         o.method = Method::blend;
         o.blending = Blending::bits8;
       }},
      {"Preshaded", "Van Gelder and Kim 1996: voxels classified and shaded first, colours interpolated",
       [](Scene&) {}, [](RenderOptions& o) { o.method = Method::preshaded; }},
      {"unlit Blend", "Cabral et al. 1994: slices blended, no light", [](Scene& s) { s.shading.lit = false; },
       [](RenderOptions& o) {
         o.method = Method::blend;
         o.blending = Blending::bits8;
       }},
      {"first-hit surface", "Sommer et al. 1998: the first surface alone, opaque and lit",
       [](Scene& s) {
         // The surface is where the curve reaches half of its highest opacity.
         auto& points = s.transferFunction.points;
         CurvePoint most = points.front();
         for (const CurvePoint& p : points)
           if (p.opacity > most.opacity) most = p;
         float value = most.value;
         for (std::size_t n = 0; n + 1 < points.size(); ++n)
           if (points[n].opacity < most.opacity / 2 && points[n + 1].opacity >= most.opacity / 2) {
             const double share =
                 (most.opacity / 2 - points[n].opacity) / (points[n + 1].opacity - points[n].opacity);
             value = float(points[n].value + share * (double(points[n + 1].value) - points[n].value));
             break;
           }
         points = {{value, most.colour, 0}, {value, most.colour, 1}};
       },
       [](RenderOptions&) {}},
  };
  return all;
}

Status measureRivals(PaperBench& bench, const PaperOptions& options, const StudyProgress& progress,
                     const CancelToken& cancel) {
  constexpr int edge = 256;
  // The last volume is the CT head or its substitute, else the translucent sphere.
  const PaperVolume& v = bench.volumes.size() > 3 ? bench.volumes.back() : bench.volumes[1];
  bench.rivalsOn =
      v.name + ", " + std::to_string(edge) + " x " + std::to_string(edge) + " pixels, step 1 voxel";
  RenderCaches caches(v.volume);
  std::optional<Truth> lit;
  for (const Rival& rival : rivals()) {
    Scene scene = v.scene;
    rival.see(scene);
    Setting setting{rival.name, rival.what, {}, 1};
    setting.options.size = {edge, edge};
    setting.options.step = 1;
    setting.options.threads = options.threads;
    rival.draw(setting.options);
    const auto study =
        measure(scene, {setting}, {.frames = options.rounds, .mostPixels = 4096}, caches, progress, cancel);
    if (!study) return study.error();
    if (study->rows.empty()) continue;
    const StudyRow& row = study->rows.front();
    if (!lit) lit = study->truth;
    bench.rivals.push_back(
        {rival.name, rival.what, row.medianMs, row.error, compare(row.pixels, lit->picture, lit->well)});
  }
  return {};
}

}  // namespace

Result<PaperBench> measurePaper(std::vector<PaperVolume> volumes, const PaperOptions& options,
                                const StudyProgress& progress, const CancelToken& cancel) {
  PaperBench bench;
  bench.volumes = std::move(volumes);
  PaperMeasurement measurement(options, progress, cancel);
  if (Status s = measurement.tables(bench); !s) return s.error();
  if (Status s = measurement.threads(bench); !s) return s.error();
  if (Status s = measurement.sizes(bench); !s) return s.error();
  if (Status s = measureRivals(bench, options, progress, cancel); !s) return s.error();
  return bench;
}

}  // namespace volumen
