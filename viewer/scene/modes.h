#pragma once

#include <array>
#include <memory>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// The values v along a ray, followed within one cell of the grid: v(s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3
/// of s = 0 .. 1 (picture.md 3: the trilinear function is a cubic there).
struct ValuesInCell {
  std::array<double, 4> c{};
  double smallest = 0, largest = 0;  ///< of v
  double lengthMm = 0;
};

/// What a projection makes of one ray, in double precision: it is given every cell that the ray crosses,
/// front to back, and tells one value, which the window turns into grey (picture.md 6).
class RayProjection {
 public:
  virtual ~RayProjection() = default;
  virtual void add(const ValuesInCell& values) = 0;
  /// Of a ray of this length, mm, that crossed a cell at least.
  virtual double value(double lengthMm) const = 0;
};

/// What of a line of sight a mode shows, which is what pointing tells.
enum class Shows { surface, largest, smallest, wholeLine };

/// A row of the table of modes. A mode without kernels is drawn by the reference: right, and slower.
struct ModeRow {
  Mode mode;          ///< its place in the table
  const char* name;   ///< in scenes and of --mode
  const char* title;  ///< in the window
  Shows shows;
  const char* ofLine;                           ///< what pointing calls the value of a whole line: "mean"
  Window hounsfield;                            ///< that CT is first shown by; composite has none
  bool hasKernels;                              ///< of methods planes, blend and gpu
  std::unique_ptr<RayProjection> (*project)();  ///< of one ray; null of composite, whose rays are integrated
};

/// In the order of Mode.
const std::vector<ModeRow>& modeRows();
const ModeRow& rowOf(Mode mode);
const char* modeName(Mode mode);

}  // namespace volumen
