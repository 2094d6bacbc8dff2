// The table of knobs (design.md 6). A new option is one row.
#include <cstdio>
#include <functional>

#include "viewer/evaluation/setting.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

namespace {

using Turn = std::function<void(Setting&)>;

struct Value {
  std::string text;
  Turn turn;
};

struct Knob {
  const char* name;
  std::vector<Value> values;
};

std::string text(double x) {
  char out[32];
  if (x > 0 && x < 1 && 1 / x == double(long(1 / x)))
    std::snprintf(out, sizeof out, "1/%ld", long(1 / x));
  else
    std::snprintf(out, sizeof out, "%g", x);
  return out;
}

// Returns one value per number; `after` is its unit.
template <class Number>
std::vector<Value> numbers(std::initializer_list<Number> all, const char* after,
                           void (*set)(Setting&, Number)) {
  std::vector<Value> out;
  for (Number x : all) out.push_back({text(double(x)) + after, [=](Setting& s) { set(s, x); }});
  return out;
}

Turn options(void (*set)(RenderOptions&)) {
  return [=](Setting& s) { set(s.options); };
}

Value level(Quality quality) {
  return {qualityName(quality), [=](Setting& s) {
            s.options.step.reset();
            s.options.quality = quality;
          }};
}

Value method(const char* name, Method method) {
  return {name, [=](Setting& s) { s.options.method = method; }};
}

Value byOpenGl(const char* name, Method method) {
  return {std::string(name) + ", OpenGL", [=](Setting& s) {
            s.options.method = method;
            s.options.resampler = Resampler::gl;
          }};
}

Value blending(const char* name, Blending blending) {
  return {name, [=](Setting& s) {
            s.options.method = Method::blend;
            s.options.blending = blending;
          }};
}

std::vector<Knob> knobs() {
  return {
      {"step", numbers(
                   {2.0, 1.0, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64}, " voxel",
                   +[](Setting& s, double x) { s.options.step = x; })},
      {"level",
       {level(Quality::draft), level(Quality::standard), level(Quality::high), level(Quality::exact)}},
      {"method",
       {method("blend", Method::blend), method("preshaded", Method::preshaded), method("GPU", Method::gpu)}},
      {"blending",
       {blending("floats", Blending::floats), blending("16 bits", Blending::bits16),
        blending("8 bits", Blending::bits8)}},
      {"resampler",
       {byOpenGl("planes", Method::planes), byOpenGl("blend", Method::blend),
        byOpenGl("preshaded", Method::preshaded)}},
      {"precision", numbers(
                        {8, 16, 32}, " bits", +[](Setting& s, int bits) { s.options.precision = bits; })},
      {"shader",
       {{"direct", options([](auto& o) { o.shader = Shader::phong; })},
        {"5-bit table", options([](auto& o) { o.shader = Shader::table; })}}},
      {"map, bilinear", numbers(
                            {8, 16, 32, 64, 128, 256}, "",
                            +[](Setting& s, int n) {
                              s.options.shader = Shader::map;
                              s.options.mapSize = n;
                              s.options.mapLookup = MapLookup::bilinear;
                            })},
      {"map, nearest", numbers(
                           {16, 64, 256}, "",
                           +[](Setting& s, int n) {
                             s.options.shader = Shader::map;
                             s.options.mapSize = n;
                             s.options.mapLookup = MapLookup::nearest;
                           })},
      {"tolerance", numbers(
                        {1.0, 0.1, 0.01, 0.001, 0.0001}, "",
                        +[](Setting& s, double tolerance) {
                          s.options.step.reset();
                          s.options.tolerance = tolerance;
                        })},
      {"stop at", numbers(
                      {1.0 / 64, 1.0 / 256, 1.0 / 1024, 1.0 / 4096, 0.0}, "",
                      +[](Setting& s, double t) { s.options.stopAt = t; })},
      {"opacity threshold", numbers(
                                {1.0 / 64, 1.0 / 256, 1.0 / 1024, 1.0 / 4096}, "",
                                +[](Setting& s, double t) { s.options.opacityThreshold = t; })},
      {"gradient",
       {{"central", options([](auto& o) { o.gradient = GradientOperator::central; })},
        {"Zucker-Hummel", options([](auto& o) { o.gradient = GradientOperator::zuckerHummel; })}}},
      {"curve table",
       numbers(
           {64, 256, 1024, 4096}, " entries", +[](Setting& s, int n) { s.options.curveTable = n; })},
      {"resolution", numbers(
                         {1.0 / 4, 1.0 / 3, 1.0 / 2, 3.0 / 4}, "",
                         +[](Setting& s, double share) { s.resolution = share; })},
  };
}

}  // namespace

RenderOptions studyBase(glm::ivec2 size, int threads) {
  RenderOptions base;
  base.size = size;
  base.threads = threads;
  base.step = 1.0 / 8;
  return base;
}

std::vector<Setting> oneKnobAtATime(const RenderOptions& base) {
  std::vector<Setting> all{{"base", "", base, 1}};
  all.front().value = base.step ? "step " + text(*base.step) + " voxel" : qualityName(base.quality);
  for (const Knob& knob : knobs())
    for (const Value& value : knob.values) {
      Setting setting{knob.name, value.text, base, 1};
      value.turn(setting);
      all.push_back(std::move(setting));
    }
  return all;
}

std::vector<Setting> gridOfKnobs(const RenderOptions& base) {
  std::vector<Setting> all;
  for (const double step : {2.0, 1.0, 1.0 / 2, 1.0 / 4, 1.0 / 8})
    for (const double resolution : {1.0, 1.0 / 2})
      for (const bool map : {false, true})
        for (const double stop : {1.0 / 256, 1.0 / 4096}) {
          Setting s{"grid", "step " + text(step), base, resolution};
          s.options.step = step;
          s.options.stopAt = stop;
          s.options.shader = map ? Shader::map : Shader::phong;
          if (map) s.options.mapSize = 32;
          s.value += (map ? ", map 32" : ", direct") + (", stop at " + text(stop));
          if (resolution < 1) s.value += ", " + text(resolution) + " resolution";
          all.push_back(std::move(s));
        }
  for (const Value& other : {method("blend", Method::blend), method("preshaded", Method::preshaded)})
    for (const double step : {1.0, 1.0 / 2, 1.0 / 4, 1.0 / 8}) {
      Setting s{"grid", other.text + ", step " + text(step), base, 1};
      other.turn(s);
      s.options.step = step;
      all.push_back(std::move(s));
    }
  return all;
}

std::string settingName(const Setting& setting) {
  for (const char* knob : {"base", "grid", "level", "method", "resampler"})
    if (setting.knob == knob) return setting.value;
  return setting.knob + " " + setting.value;
}

std::string methodName(const RenderOptions& options) {
  return std::string(methodName(options.method)) +
         (options.resampler == Resampler::gl && options.method != Method::gpu ? ", OpenGL" : "");
}

}  // namespace volumen
