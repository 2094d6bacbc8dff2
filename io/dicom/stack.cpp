#include "io/dicom/stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numeric>

#include "io/dicom/lines.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

constexpr double gridTolerance = 0.01;  // fraction of the slice distance (design.md 10)

// Slices this close to an even grid are on it, as scanners round and tables shake (design.md 10).
double mostJitterMm(double distance) { return std::min(0.02 * distance, 0.1); }

glm::dvec3 normalOf(const Slice& slice) {
  return glm::normalize(glm::cross(slice.orientation->row, slice.orientation->column));
}

/// Returns the names of the attributes missing for a position in mm.
std::string missingPlace(const Slice& slice) {
  std::string missing;
  const auto add = [&](bool there, const char* name) {
    if (!there) missing += (missing.empty() ? "" : ", ") + std::string(name);
  };
  add(slice.position.has_value(), "ImagePositionPatient");
  add(slice.orientation.has_value(), "ImageOrientationPatient");
  add(slice.spacing.has_value(), "PixelSpacing");
  return missing;
}

/// Returns the distance of each slice from the first, mm along the line. Uses planes, so that it always
/// increases.
std::vector<double> alongLine(std::span<const PlacedSlice> slices) {
  const glm::dvec3 normal = normalOf(slices[0].slice), first = *slices[0].slice->position;
  const double cosine = glm::dot(stackDirection(slices).unit, normal);
  std::vector<double> along;
  for (const PlacedSlice& s : slices) along.push_back(glm::dot(*s.slice->position - first, normal) / cosine);
  return along;
}

void warnOfShear(std::span<const PlacedSlice> slices, Stack& stack) {
  const StackDirection line = stackDirection(slices);
  if (!line.tilted) return;
  const double cosine = std::min(1.0, std::abs(glm::dot(line.unit, normalOf(slices[0].slice))));
  const double degrees = std::acos(cosine) * 180 / 3.14159265358979323846;
  if (degrees < 0.05) return;
  char text[80];
  std::snprintf(text, sizeof text, "Gantry tilt of %.1f degrees, corrected in 3D.", degrees);
  stack.warnings.push_back({text, WarningKind::sheared});
}

void warnOffLine(std::span<const PlacedSlice> slices, const std::vector<double>& along, Stack& stack) {
  const glm::dvec3 line = stackDirection(slices).unit, first = *slices[0].slice->position;
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const double off = glm::length(*slices[n].slice->position - first - along[n] * line);
    if (off > worst) worst = off, at = n;
  }
  const double pixel = std::min(slices[0].slice->spacing->x, slices[0].slice->spacing->y);
  if (worst > 0.1 * pixel)
    stack.warnings.push_back({"The slices do not lie on one line: " + fileName(slices[at].path) + " is " +
                                  millimetres(worst) + " mm beside it and was moved onto it.",
                              WarningKind::offLine});
}

/// Returns the two slices and the weight for the position `mm` along the line; a copy if a slice is within
/// `tolerance` mm.
Stack::Source sourceAt(const std::vector<double>& along, double mm, double tolerance) {
  const auto above = std::upper_bound(along.begin(), along.end(), mm);
  const int below =
      int(std::clamp<std::ptrdiff_t>(above - along.begin() - 1, 0, std::ptrdiff_t(along.size()) - 2));
  const double from = along[std::size_t(below)], to = along[std::size_t(below) + 1];
  if (std::abs(mm - from) <= tolerance) return {below, 0};
  if (std::abs(mm - to) <= tolerance) return {below + 1, 0};
  return {below, std::clamp((mm - from) / (to - from), 0.0, 1.0)};
}

/// Returns the place of each slice on a grid of `distance` if every step is a whole multiple of it (within 5
/// %), else nothing.
std::vector<int> gridPlaces(const std::vector<double>& steps, double distance) {
  std::vector<int> places{0};
  for (double step : steps) {
    const double count = std::round(step / distance);
    if (count < 1 || std::abs(step - count * distance) > 0.05 * distance) return {};
    places.push_back(places.back() + int(count));
  }
  return places;
}

/// Returns the number of slices missing on such a grid; 0 if there is no grid.
int missingSlices(const std::vector<double>& steps, double distance) {
  const std::vector<int> places = gridPlaces(steps, distance);
  return places.empty() ? 0 : places.back() - int(steps.size());
}

/// Returns whether slices at these places of a grid are even except for jitter, by the least-squares grid.
bool isEven(const std::vector<double>& along, const std::vector<int>& places) {
  const double count = double(along.size());
  double meanPlace = 0, meanMm = 0, together = 0, spread = 0;
  for (std::size_t n = 0; n < along.size(); ++n) meanPlace += places[n] / count, meanMm += along[n] / count;
  for (std::size_t n = 0; n < along.size(); ++n) {
    together += (places[n] - meanPlace) * (along[n] - meanMm);
    spread += (places[n] - meanPlace) * (places[n] - meanPlace);
  }
  const double distance = together / spread;
  constexpr double rounding = 1e-6;  // rounding of decimals in files, mm
  for (std::size_t n = 0; n < along.size(); ++n)
    if (std::abs(along[n] - meanMm - distance * (places[n] - meanPlace)) > mostJitterMm(distance) + rounding)
      return false;
  return true;
}

bool isEven(const std::vector<double>& along) {
  std::vector<int> places(along.size());
  std::iota(places.begin(), places.end(), 0);
  return isEven(along, places);
}

std::string missingSentence(int missing, const std::string& between, double most, double median) {
  const std::string gap = between + " (" + millimetres(most) + " mm instead of " + millimetres(median) + ")";
  if (missing == 1) return "A slice is missing between " + gap + "; it was interpolated.";
  return std::to_string(missing) + " slices are missing, the most between " + gap +
         "; they were interpolated.";
}

Warning unevenWarning(std::span<const PlacedSlice> slices, const std::vector<double>& steps, double distance,
                      const Stack& stack, double cutMm) {
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  const std::size_t at = std::size_t(most - steps.begin());
  const std::string between = fileName(slices[at].path) + " and " + fileName(slices[at + 1].path);
  const int missing = missingSlices(steps, distance), interpolated = stack.regular->interpolatedSlices;
  std::string text = missing
                         ? missingSentence(missing, between, *most, distance)
                         : "Uneven slice spacing (" + millimetres(*least) + " to " + millimetres(*most) +
                               " mm, largest between " + between + "): " + std::to_string(interpolated) +
                               " of the " + std::to_string(stack.regular->geometry.size.z) +
                               " slices shown in 3D " + (interpolated == 1 ? "is" : "are") + " interpolated.";
  if (cutMm > gridTolerance * distance)
    text += " The last " + millimetres(cutMm) + " mm are not shown in 3D.";
  return {text, missing ? WarningKind::missingSlices : WarningKind::unevenSlices};
}

/// Adds the regular grid of design.md 10, starting at the first slice. Its distance is the median, or the
/// mean if slices are even except for missing ones.
void addRegularGrid(std::span<const PlacedSlice> slices, const std::vector<double>& along, Stack& stack) {
  const std::vector<double> steps = stepsMm(slices);
  double distance = lowerMedian(steps), tolerance = gridTolerance * distance;
  const std::vector<int> places = gridPlaces(steps, distance);
  if (!places.empty() && isEven(along, places)) {
    distance = along.back() / places.back();
    tolerance = 2 * mostJitterMm(distance);  // the first slice is off as well
  }
  const int count = int(std::floor(along.back() / distance + gridTolerance)) + 1;
  Series::Regular regular{stack.acquired, 0, {}};
  regular.geometry.size.z = count;
  regular.geometry.patientFromVoxelStep[2] = distance * stackDirection(slices).unit;
  for (int k = 0; k < count; ++k) {
    stack.sources.push_back(sourceAt(along, k * distance, tolerance));
    const auto& [below, weight] = stack.sources.back();
    if (weight > 0) ++regular.interpolatedSlices;
    regular.copies.push_back(weight > 0 ? -1 : below);
  }
  for (int n = 0; n < int(along.size()) && stack.places.empty(); ++n)
    if (std::ranges::find(regular.copies, n) == regular.copies.end())
      for (const double mm : along) stack.places.push_back(mm / distance);
  stack.regular = regular;
  stack.warnings.push_back(
      unevenWarning(slices, steps, distance, stack, along.back() - (count - 1) * distance));
}

void layOutSingle(const PlacedSlice& only, Stack& stack) {
  const bool known = only.slice->thickness > 0;
  stack.acquired.patientFromVoxelStep[2] = normalOf(only.slice) * (known ? only.slice->thickness : 1.0);
  if (!known) stack.warnings.emplace_back("A single slice of unknown thickness: shown 1 mm thick.");
}

}  // namespace

Stack layOut(std::span<const PlacedSlice> slices, int columns, int rows) {
  Stack stack;
  stack.acquired.size = {columns, rows, int(slices.size())};
  const auto lost =
      std::find_if(slices.begin(), slices.end(), [](const PlacedSlice& s) { return !isPlaced(s.slice); });
  if (lost != slices.end()) {
    stack.acquired.calibrated = false;
    stack.warnings.push_back({"Not calibrated: no measurements in mm in 3D, no orientation (" +
                                  fileName(lost->path) + " has no valid " + missingPlace(lost->slice) +
                                  "); shown with voxels of 1 mm.",
                              WarningKind::notCalibrated});
    return stack;
  }
  const Slice& first = slices[0].slice;
  if (first.ofTransducer)
    stack.warnings.push_back(
        {"It lies in the space of its transducer: which side of the patient is left, front "
         "or top is not known.",
         WarningKind::noDirections});
  stack.acquired.origin = *first.position;
  stack.acquired.patientFromVoxelStep[0] = first.orientation->row * first.spacing->x;
  stack.acquired.patientFromVoxelStep[1] = first.orientation->column * first.spacing->y;
  if (slices.size() == 1) {
    layOutSingle(slices[0], stack);
    return stack;
  }
  const std::vector<double> along = alongLine(slices);
  stack.acquired.patientFromVoxelStep[2] =
      stackDirection(slices).unit * (along.back() / double(slices.size() - 1));
  warnOfShear(slices, stack);
  warnOffLine(slices, along, stack);
  if (!isEven(along)) addRegularGrid(slices, along, stack);
  return stack;
}

std::vector<double> stepsMm(std::span<const PlacedSlice> slices) {
  const std::vector<double> along = alongLine(slices);
  std::vector<double> steps;
  for (std::size_t n = 1; n < along.size(); ++n) steps.push_back(along[n] - along[n - 1]);
  return steps;
}

double lowerMedian(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string millimetres(double mm) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f", mm);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.ends_with('.')) s.pop_back();
  return s;
}

}  // namespace volumen::dicom
