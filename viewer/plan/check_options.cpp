#include "viewer/plan/check_options.h"

#include <string>

#include "viewer/scene/modes.h"

namespace volumen {

namespace {

Status checkShader(const Scene& scene, const RenderOptions& o) {
  const bool ofMap = o.mapSize || o.mapLookup;
  const std::string option = o.mapSize ? "--map-size" : "--map-lookup";
  if (ofMap && (o.shader == Shader::phong || o.shader == Shader::table))
    return Error{option + " goes with --shader map alone."};
  const bool fixedViewer = o.shader == Shader::table || o.shader == Shader::map || ofMap;
  if (!fixedViewer || !scene.shading.localViewer) return {};
  const std::string shader = o.shader == Shader::table ? "--shader table" : ofMap ? option : "--shader map";
  return Error{shader +
               " cannot draw shading.localViewer: the viewer's direction changes from ray to ray; use "
               "--shader phong."};
}

Status checkTolerance(const Scene& scene, const RenderOptions& o) {
  if (!o.tolerance) return {};
  if (!(*o.tolerance >= 1e-6 && *o.tolerance <= 1)) return Error{"--tolerance must be 0.000001 to 1."};
  if (!o.step && canIntegrate(scene, o)) return {};
  return Error{
      "--tolerance goes with the levels of --method planes on the CPU alone: not with --step, projections, "
      "--shader table or --map-lookup nearest."};
}

// Refuses options that the reference does not have, because it draws the picture's definition.
Status checkKnobs(const Scene& scene, const RenderOptions& o) {
  if (o.stopAt && !(*o.stopAt >= 0 && *o.stopAt < 1)) return Error{"--stop-at must be 0 to 1, below 1."};
  if (o.stopAt && o.method == Method::blend &&
      (o.resampler == Resampler::gl || o.blending.value_or(Blending::floats) != Blending::floats))
    return Error{"--stop-at goes with --method blend on the CPU and in floats alone."};
  if (o.opacityThreshold && !(*o.opacityThreshold >= 0 && *o.opacityThreshold < 1))
    return Error{"--opacity-threshold must be 0 to 1, below 1."};
  if (o.curveTable && (*o.curveTable < 2 || *o.curveTable > 65536))
    return Error{"--curve-table must be 2 to 65536."};
  const bool used = o.stopAt || o.opacityThreshold || o.curveTable || o.gradient != GradientOperator::sobel;
  if (!used || methodOf(scene, o) != Method::reference) return {};
  return Error{
      "--stop-at, --opacity-threshold, --curve-table and --gradient do not go with --method reference, which "
      "draws the picture's definition."};
}

Status checkPrecision(const RenderOptions& o) {
  if (o.precision && *o.precision != 8 && *o.precision != 16 && *o.precision != 32)
    return Error{"--precision must be 8, 16 or 32."};
  const bool byCpu = o.resampler.value_or(Resampler::cpu) == Resampler::cpu;
  if (o.precision != 8 || (byCpu && (o.method == Method::planes || o.method == Method::blend))) return {};
  return Error{"--precision 8 goes with --method planes and blend alone, resampled by the CPU."};
}

Status checkMethod(const Scene& scene, const RenderOptions& o) {
  if (o.method != Method::planes && o.method != Method::reference && !rowOf(scene.mode).hasKernels)
    return Error{std::string("--mode ") + modeName(scene.mode) + " is drawn by --method reference alone."};
  if (o.method == Method::preshaded && scene.mode != Mode::composite)
    return Error{std::string("--method preshaded does not go with --mode ") + modeName(scene.mode) +
                 ": shaded voxels have no values left to project."};
  if (o.method == Method::gpu && o.resampler == Resampler::cpu)
    return Error{"--resampler cpu does not go with --method gpu, which is OpenGL's alone."};
  if (o.blending && o.method != Method::blend)
    return Error{"--blending goes with --method blend alone: the other methods composite in floats."};
  if (o.blending && *o.blending != Blending::floats && scene.mode == Mode::average)
    return Error{"--blending 8 and 16 do not go with --mode average: its sum needs floats."};
  return {};
}

}  // namespace

Method methodOf(const Scene& scene, const RenderOptions& o) {
  return rowOf(scene.mode).hasKernels ? o.method : Method::reference;
}

bool canIntegrate(const Scene& scene, const RenderOptions& o) {
  return scene.mode == Mode::composite && o.method == Method::planes && o.resampler != Resampler::gl &&
         o.precision != 8 && o.shader != Shader::table && o.mapLookup != MapLookup::nearest;
}

Status checkOptions(const Scene& scene, const RenderOptions& o) {
  if (o.size.x < 1 || o.size.y < 1 || o.size.x > 32768 || o.size.y > 32768)
    return Error{"--size must be 1x1 to 32768x32768."};
  if (o.step && !(*o.step >= 1.0 / 1024 && *o.step <= 64))
    return Error{"--step must be 1/1024 to 64 voxels."};
  if (Status s = checkPrecision(o); !s) return s;
  if (o.mapSize && (*o.mapSize < 2 || *o.mapSize > 1024)) return Error{"--map-size must be 2 to 1024."};
  if (o.threads < 0 || o.threads > 1024) return Error{"--threads must be 1 to 1024."};
  if (o.resampler == Resampler::gl && o.method == Method::reference)
    return Error{
        "--resampler gl does not go with --method reference, which interpolates in double precision."};
  if (Status s = checkTolerance(scene, o); !s) return s;
  if (Status s = checkKnobs(scene, o); !s) return s;
  if (Status s = checkMethod(scene, o); !s) return s;
  return checkShader(scene, o);
}

}  // namespace volumen
