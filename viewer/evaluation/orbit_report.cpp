#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/evaluation/orbit.h"
#include "viewer/evaluation/statistics.h"

namespace volumen {

namespace {

struct Samples {
  double resampled = 0, shaded = 0, composited = 0;
};

// Returns the means over the views.
Samples meanSamples(const Orbit& orbit) {
  Samples sum;
  for (const OrbitView& v : orbit.views) {
    sum.resampled += double(v.stats.resampled);
    sum.shaded += double(v.stats.shaded);
    sum.composited += double(v.stats.composited);
  }
  const double n = double(orbit.views.size());
  return {sum.resampled / n, sum.shaded / n, sum.composited / n};
}

std::string line(const char* name, const std::vector<double>& frames, const std::vector<double>& processors,
                 const Samples& s) {
  char text[480];
  std::snprintf(text, sizeof text, "%-8s %9.2f %9.2f %12.2f %11.3f %9.3f %11.3f\n", name, median(frames),
                minimum(frames), median(processors), s.resampled / 1e6, s.shaded / 1e6, s.composited / 1e6);
  return text;
}

}  // namespace

std::string orbitText(const Orbit& orbit) {
  const RenderStats& s = orbit.views.front().stats;
  char text[320];
  std::snprintf(text, sizeof text,
                "%d x %d, step %.4g voxel, %d threads, %s, %zu frames a view\nfirst frame %.1f ms, of it "
                "gradients and copies %.1f ms\n\nview     median ms   minimum processor ms   resampled    "
                "shaded  composited (million)\n",
                orbit.plan.options.size.x, orbit.plan.options.size.y, orbit.plan.stepVoxels, s.threads,
                s.kernel.c_str(), orbit.views.front().framesMs.size(), orbit.firstFrameMs, orbit.gradientsMs);
  std::string out = text;
  for (const OrbitView& v : orbit.views) {
    std::snprintf(text, sizeof text, "%.4g", v.angleDegrees);
    out += line(text, v.framesMs, v.processorsMs,
                {double(v.stats.resampled), double(v.stats.shaded), double(v.stats.composited)});
  }
  return out + line("all", allFramesMs(orbit), allProcessorsMs(orbit), meanSamples(orbit));
}

std::string orbitJson(const Orbit& orbit) {
  using Json = nlohmann::ordered_json;
  const auto times = [](const std::vector<double>& frames, const std::vector<double>& processors) {
    return Json{{"medianMs", median(frames)},
                {"minimumMs", minimum(frames)},
                {"medianProcessorMs", median(processors)},
                {"minimumProcessorMs", minimum(processors)}};
  };
  Json views = Json::array();
  for (const OrbitView& v : orbit.views) {
    Json view{{"angle", v.angleDegrees}};
    view.update(times(v.framesMs, v.processorsMs));
    view["framesMs"] = v.framesMs;
    view["resampled"] = v.stats.resampled;
    view["shaded"] = v.stats.shaded;
    view["composited"] = v.stats.composited;
    views.push_back(view);
  }
  const RenderStats& s = orbit.views.back().stats;
  Json all = times(allFramesMs(orbit), allProcessorsMs(orbit));
  const Samples samples = meanSamples(orbit);
  all["resampled"] = samples.resampled;
  all["shaded"] = samples.shaded;
  all["composited"] = samples.composited;
  const Json out{{"size", {orbit.plan.options.size.x, orbit.plan.options.size.y}},
                 {"step", orbit.plan.stepVoxels},
                 {"threads", s.threads},
                 {"kernel", s.kernel},
                 {"firstFrameMs", orbit.firstFrameMs},
                 {"gradientsMs", orbit.gradientsMs},
                 {"bytes",
                  {{"density", s.densityBytes},
                   {"gradients", s.gradientBytes},
                   {"blocks", s.blockBytes},
                   {"tables", s.tableBytes}}},
                 {"plan", Json::parse(explainJson(orbit.plan))},
                 {"views", views},
                 {"overall", all}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace volumen
