#pragma once

#include <array>
#include <memory>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// Values v along a ray within one grid cell: v(s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3 for s = 0 .. 1
/// (picture.md 3: the trilinear function is a cubic along a line).
struct ValuesInCell {
  std::array<double, 4> c{};
  double smallest = 0, largest = 0;  ///< Smallest and largest v
  double lengthMm = 0;
};

/// Projects one ray to a value in double precision. It receives every cell the ray crosses, front to back;
/// the window turns the value into grey (picture.md 6).
class RayProjection {
 public:
  virtual ~RayProjection() = default;
  virtual void add(const ValuesInCell& values) = 0;
  /// Returns the result for a ray of this length in mm that crossed at least one cell.
  virtual double value(double lengthMm) const = 0;
};

/// The part of a line of sight that a mode shows and that picking reports.
enum class Shows { surface, largest, smallest, wholeLine };

/// A row of the table of modes. Modes without kernels are drawn by the slower, exact reference.
struct ModeRow {
  Mode mode;          ///< Also the row's index in the table
  const char* name;   ///< Word in scenes and for --mode
  const char* title;  ///< Label in the window
  Shows shows;
  const char* ofLine;  ///< Picking's name for the value of a whole line: "mean"
  Window hounsfield;   ///< Initial window for CT; composite has none
  bool hasKernels;     ///< True if methods planes, blend and gpu can draw it
  /// Makes the projection of one ray; null for composite, which integrates rays.
  std::unique_ptr<RayProjection> (*project)();
};

/// Returns the rows in the order of Mode.
const std::vector<ModeRow>& modeRows();
const ModeRow& rowOf(Mode mode);
const char* modeName(Mode mode);

}  // namespace volumen
