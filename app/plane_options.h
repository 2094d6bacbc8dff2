#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "app/open_volume.h"
#include "viewer/slice/slice.h"
#include "viewer/volume/result.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The options that place a plane in a volume (slices.md), as typed.
struct PlaneOptions {
  std::string plane = "axial", centre, right, down, size, slabMode = "max", interpolation = "linear";
  std::optional<double> at, mmPerPixel;
  std::optional<int> index;
  double slabMm = 0;
  bool average = false;
};

/// The parsed options, before the volume is known.
struct AskedPlane {
  std::optional<glm::dvec3> centre;
  std::optional<std::pair<glm::dvec3, glm::dvec3>> rightAndDown;  ///< orthogonal unit vectors
  std::optional<glm::ivec2> size;
};

/// The word of --plane for an image as acquired.
inline constexpr const char* acquiredPlane = "frame";

/// Adds --plane, --at, --index, --centre, --right, --down, --mm-per-pixel, --slab, --slab-mode,
/// --interpolation and --average. `takesFrame`: --plane may be acquiredPlane.
void addPlaneOptions(CLI::App& app, PlaneOptions& options, bool takesFrame);

/// Parses the options. The Error (wrong usage) names the option.
Result<AskedPlane> readPlane(const PlaneOptions& options);
/// Returns the plane in a volume. The Error: it does not meet the volume, or has no slice of this index.
Result<SlicePlane> makePlane(const PlaneOptions& options, const AskedPlane& asked,
                             const VoxelGeometry& geometry);
/// Returns the interpolation of --interpolation.
Interpolation interpolationOf(const PlaneOptions& options);
/// Adds a note that --index counts the slices of the displayed volume, where these are not the acquired ones.
void noteEvenSlices(const PlaneOptions& options, Opened& opened);
/// Adds --window.
void addWindow(CLI::App& app, std::string& window);
/// Parses centre and width of an option; empty for an empty text. The Error (wrong usage) names the option.
Result<std::optional<Window>> windowOf(const std::string& text, const std::string& option = "--window");

/// Returns a plane as `slice --print-plane` writes it.
nlohmann::ordered_json planeJson(const SlicePlane& plane);

}  // namespace volumen
