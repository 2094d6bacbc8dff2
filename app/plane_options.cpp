#include "app/plane_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/option_words.h"
#include "app/usage.h"

namespace volumen {

namespace {

const OptionWords<NamedPlane> planes{
    {"axial", NamedPlane::axial}, {"coronal", NamedPlane::coronal}, {"sagittal", NamedPlane::sagittal}};
const OptionWords<SlabMode> slabModes{
    {"max", SlabMode::max}, {"min", SlabMode::min}, {"mean", SlabMode::mean}};
const OptionWords<Interpolation> interpolations{
    {"linear", Interpolation::linear}, {"nearest", Interpolation::nearest}, {"cubic", Interpolation::cubic}};

Result<glm::dvec3> readVector(const std::string& option, const std::string& text) {
  const auto numbers = numbersOf(option, text, 3, "0,0.5,-12");
  if (!numbers) return numbers.error();
  return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Status readDirections(const PlaneOptions& options, AskedPlane& asked) {
  if (options.right.empty()) return {};
  const auto right = readVector("--right", options.right), down = readVector("--down", options.down);
  if (!right) return right.error();
  if (!down) return down.error();
  if (!(glm::length(*right) > 0) || !(glm::length(*down) > 0))
    return Error{"--right and --down are directions; 0,0,0 is none."};
  const glm::dvec3 r = glm::normalize(*right), d = glm::normalize(*down);
  if (std::abs(glm::dot(r, d)) > 1e-3) return Error{"--right and --down are not at a right angle."};
  asked.rightAndDown = {r, glm::normalize(d - glm::dot(r, d) * r)};
  return {};
}

// Returns the axis of --at.
int axisOf(NamedPlane plane) { return plane == NamedPlane::axial ? 2 : plane == NamedPlane::coronal ? 1 : 0; }

Result<SlicePlane> onIndex(const SlicePlane& plane, const VoxelGeometry& geometry, int index) {
  if (index >= geometry.size.z)
    return Error{"--index " + std::to_string(index) + ": the slices are 0 to " +
                 std::to_string(geometry.size.z - 1) + "."};
  const auto on = onSlice(plane, geometry, index);
  if (!on)
    return Error{
        "--index: the plane is not parallel to the slices; say where it lies with --at or --centre."};
  return *on;
}

// The Error: the plane or slab does not meet the volume, so the picture would be empty.
Status checkMeets(const SlicePlane& plane, const VoxelGeometry& geometry) {
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;  // along the normal, from the plane
  for (const glm::dvec3& place : geometry.boxCorners()) {
    const double along = glm::dot(place - plane.centre, plane.normal());
    low = glm::min(low, place), high = glm::max(high, place);
    nearest = std::min(nearest, along), farthest = std::max(farthest, along);
  }
  const double reach = 0.5 * plane.slabMm + 1e-6;
  if (nearest <= reach && farthest >= -reach) return {};
  char text[160];
  std::snprintf(text, sizeof text, "x %.1f to %.1f, y %.1f to %.1f, z %.1f to %.1f mm.", low.x, high.x, low.y,
                high.y, low.z, high.z);
  return Error{std::string("The plane lies outside of the volume, which reaches from ") + text};
}

}  // namespace

Result<AskedPlane> readPlane(const PlaneOptions& options) {
  AskedPlane asked;
  if (!options.centre.empty()) {
    const auto centre = readVector("--centre", options.centre);
    if (!centre) return centre.error();
    asked.centre = *centre;
  }
  if (Status s = readDirections(options, asked); !s) return s.error();
  if (options.size.empty()) return asked;
  const auto size = sizeOf(options.size);
  if (!size) return size.error();
  asked.size = *size;
  return asked;
}

Result<SlicePlane> makePlane(const PlaneOptions& options, const AskedPlane& asked,
                             const VoxelGeometry& geometry) {
  const NamedPlane name = meaning(planes, options.plane);
  SlicePlane plane = asked.rightAndDown
                         ? planeAlong(geometry, asked.rightAndDown->first, asked.rightAndDown->second)
                         : namedPlane(geometry, name);
  if (asked.centre) plane.centre = *asked.centre;
  if (options.at) plane.centre[axisOf(name)] = *options.at;
  if (options.mmPerPixel) plane.mmPerPixel = *options.mmPerPixel;
  plane.size = asked.size ? *asked.size : sizeToCover(geometry, plane);
  plane.slabMm = options.slabMm;
  plane.slabMode = meaning(slabModes, options.slabMode);
  plane.interpolation = interpolationOf(options);
  plane.average = options.average;
  if (!options.index) {
    if (Status meets = checkMeets(plane, geometry); !meets) return meets.error();
    return plane;
  }
  return onIndex(plane, geometry, *options.index);
}

Interpolation interpolationOf(const PlaneOptions& options) {
  return meaning(interpolations, options.interpolation);
}

nlohmann::ordered_json planeJson(const SlicePlane& plane) {
  const auto vector = [](glm::dvec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  return {{"centre", vector(plane.centre)},
          {"right", vector(plane.right)},
          {"down", vector(plane.down)},
          {"mmPerPixel", plane.mmPerPixel},
          {"size", {plane.size.x, plane.size.y}},
          {"slabMm", plane.slabMm},
          {"slabMode", wordOf(slabModes, plane.slabMode)},
          {"interpolation", wordOf(interpolations, plane.interpolation)},
          {"average", plane.average}};
}

void noteEvenSlices(const PlaneOptions& options, Opened& opened) {
  if (!options.index || opened.loaded.drawn == opened.loaded.acquired) return;
  opened.notes.push_back("--index counts the evenly spaced slices that are shown in 3D: " +
                         std::to_string(opened.loaded.drawn->size().z) + ".");
}

Result<std::optional<Window>> windowOf(const std::string& text, const std::string& option) {
  if (text.empty()) return std::optional<Window>();
  const auto window = numbersOf(option, text, 2, "40,400");
  if (!window) return window.error();
  if (!((*window)[1] > 0)) return Error{option + ": the width must be above 0."};
  return std::optional(Window{(*window)[0], (*window)[1]});
}

void addPlaneOptions(CLI::App& app, PlaneOptions& o, bool takesFrame) {
  constexpr double farMm = 1e6;
  std::vector<std::string> names = keys(planes);
  if (takesFrame) names.emplace_back(acquiredPlane);
  const std::string other = takesFrame ? ", or a picture as acquired: frame" : "";
  CLI::Option* plane =
      oneOf(app.add_option("--plane", o.plane, "The plane" + other + " (default: axial)"), names);
  CLI::Option* at = number(app.add_option("--at", o.at,
                                          "Where the plane lies: z of an axial, y of a coronal, x of a "
                                          "sagittal one, in mm (default: the volume's centre)"),
                           -farMm, farMm);
  CLI::Option* index =
      wholeNumber(app.add_option("--index", o.index,
                                 "The N-th slice or frame, from 0; of a plane parallel to the slices"),
                  0, 1000000);
  CLI::Option* centre =
      app.add_option("--centre", o.centre, "The centre of the picture, in mm (default: the volume's)");
  CLI::Option* right =
      app.add_option("--right", o.right, "Where the right of the picture is, a direction in the patient");
  CLI::Option* down = app.add_option("--down", o.down, "Where the bottom of the picture is");
  for (CLI::Option* vector : {centre, right, down}) vector->type_name("X,Y,Z");
  right->needs(down)->excludes(plane)->excludes(at);
  down->needs(right);
  at->excludes(index)->excludes(centre);
  index->excludes(centre);
  number(
      app.add_option("--mm-per-pixel", o.mmPerPixel, "Size of a pixel (default: the smallest voxel spacing)"),
      1e-6, 1e6);
  CLI::Option* slab =
      number(app.add_option("--slab", o.slabMm, "Thickness of a slab around the plane, in mm"), 0, 1e6);
  oneOf(app.add_option("--slab-mode", o.slabMode, "What of a slab is shown (default: max)"), keys(slabModes))
      ->needs(slab);
  oneOf(app.add_option("--interpolation", o.interpolation, "Between voxels (default: linear)"),
        keys(interpolations));
  app.add_flag("--average", o.average, "Average over pixels that are larger than voxels");
}

void addWindow(CLI::App& app, std::string& window) {
  app.add_option("--window", window,
                 "Centre and width of the values from black to white (default: the file's, else nearly all)")
      ->type_name("C,W");
}

}  // namespace volumen
