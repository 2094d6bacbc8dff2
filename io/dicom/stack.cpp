#include "io/dicom/stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace volumen::dicom {
namespace {

constexpr double gridTolerance = 0.01;  // of the distance between slices (DESIGN 10)

glm::dvec3 normalOf(const Slice& slice) {
  return glm::normalize(glm::cross(slice.orientation->row, slice.orientation->column));
}

/// What is missing for millimetres.
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

/// Unit direction from the first slice to the last; the normal for a single one.
glm::dvec3 lineDirection(std::span<const PlacedSlice> slices) {
  if (slices.size() < 2) return normalOf(slices[0].slice);
  return glm::normalize(*slices.back().slice.position - *slices.front().slice.position);
}

/// Distances of all slices from the first, mm along the line: by their planes, so that they always increase.
std::vector<double> alongLine(std::span<const PlacedSlice> slices) {
  const glm::dvec3 normal = normalOf(slices[0].slice), first = *slices[0].slice.position;
  const double cosine = glm::dot(lineDirection(slices), normal);
  std::vector<double> along;
  for (const PlacedSlice& s : slices) along.push_back(glm::dot(*s.slice.position - first, normal) / cosine);
  return along;
}

void warnOfShear(std::span<const PlacedSlice> slices, Stack& stack) {
  const double cosine = std::min(1.0, std::abs(glm::dot(lineDirection(slices), normalOf(slices[0].slice))));
  const double degrees = std::acos(cosine) * 180 / 3.14159265358979323846;
  if (degrees < 0.05) return;
  char text[80];
  std::snprintf(text, sizeof text, "Gantry tilt of %.1f degrees, corrected in 3D.", degrees);
  stack.warnings.push_back(text);
}

void warnOffLine(std::span<const PlacedSlice> slices, const std::vector<double>& along, Stack& stack) {
  const glm::dvec3 line = lineDirection(slices), first = *slices[0].slice.position;
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const double off = glm::length(*slices[n].slice.position - first - along[n] * line);
    if (off > worst) worst = off, at = n;
  }
  const double pixel = std::min(slices[0].slice.spacing->x, slices[0].slice.spacing->y);
  if (worst > 0.1 * pixel)
    stack.warnings.push_back("The slices do not lie on one line: " + fileName(slices[at].path) + " is " +
                             millimetres(worst) + " mm beside it and was moved onto it.");
}

/// Which two slices, and with what weight, make up the place `mm` along the line; a copy where a slice is
/// within 1 % of `distance`.
Stack::Source sourceAt(const std::vector<double>& along, double mm, double distance) {
  const auto above = std::upper_bound(along.begin(), along.end(), mm);
  const int below =
      int(std::clamp<std::ptrdiff_t>(above - along.begin() - 1, 0, std::ptrdiff_t(along.size()) - 2));
  const double from = along[std::size_t(below)], to = along[std::size_t(below) + 1];
  if (std::abs(mm - from) <= gridTolerance * distance) return {below, 0};
  if (std::abs(mm - to) <= gridTolerance * distance) return {below + 1, 0};
  return {below, std::clamp((mm - from) / (to - from), 0.0, 1.0)};
}

/// How many slices are missing, where every step is a whole number of medians (within 5 %); else 0.
int missingSlices(const std::vector<double>& steps, double median) {
  int missing = 0;
  for (double step : steps) {
    const double count = std::round(step / median);
    if (count < 1 || std::abs(step - count * median) > 0.05 * median) return 0;
    missing += int(count) - 1;
  }
  return missing;
}

std::string missingSentence(int missing, const std::string& between, double most, double median) {
  const std::string gap = between + " (" + millimetres(most) + " mm instead of " + millimetres(median) + ")";
  if (missing == 1) return "A slice is missing between " + gap + "; it was interpolated.";
  return std::to_string(missing) + " slices are missing, the most between " + gap +
         "; they were interpolated.";
}

std::string unevenSentence(std::span<const PlacedSlice> slices, const std::vector<double>& steps,
                           double median, const Stack& stack, double cutMm) {
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  const std::size_t at = std::size_t(most - steps.begin());
  const std::string between = fileName(slices[at].path) + " and " + fileName(slices[at + 1].path);
  std::string text;
  if (const int missing = missingSlices(steps, median))
    text = missingSentence(missing, between, *most, median);
  else
    text = "Uneven slice spacing (" + millimetres(*least) + " to " + millimetres(*most) +
           " mm, largest between " + between + "): " + std::to_string(stack.regular->interpolatedSlices) +
           " of the " + std::to_string(stack.regular->geometry.size.z) + " slices shown in 3D " +
           (stack.regular->interpolatedSlices == 1 ? "is" : "are") + " interpolated.";
  if (cutMm > gridTolerance * median) text += " The last " + millimetres(cutMm) + " mm are not shown in 3D.";
  return text;
}

/// Adds the regular grid of DESIGN 10: the median distance, from the first slice on.
void addRegularGrid(std::span<const PlacedSlice> slices, const std::vector<double>& along, Stack& stack) {
  const std::vector<double> steps = stepsMm(slices);
  const double median = lowerMedian(steps);
  const int count = int(std::floor(along.back() / median + gridTolerance)) + 1;
  Series::Regular regular{stack.acquired, 0};
  regular.geometry.size.z = count;
  regular.geometry.patientFromVoxelStep[2] = median * lineDirection(slices);
  for (int k = 0; k < count; ++k) {
    stack.sources.push_back(sourceAt(along, k * median, median));
    if (stack.sources.back().weight > 0) ++regular.interpolatedSlices;
  }
  stack.regular = regular;
  stack.warnings.push_back(unevenSentence(slices, steps, median, stack, along.back() - (count - 1) * median));
}

bool isEven(const std::vector<double>& along) {
  const double mean = along.back() / double(along.size() - 1);
  for (std::size_t n = 0; n < along.size(); ++n)
    if (std::abs(along[n] - double(n) * mean) > gridTolerance * mean) return false;
  return true;
}

void layOutSingle(const PlacedSlice& only, Stack& stack) {
  const bool known = only.slice.thickness > 0;
  stack.acquired.patientFromVoxelStep[2] = normalOf(only.slice) * (known ? only.slice.thickness : 1.0);
  if (!known) stack.warnings.push_back("A single slice of unknown thickness: shown 1 mm thick.");
}

}  // namespace

Stack layOut(std::span<const PlacedSlice> slices, int columns, int rows) {
  Stack stack;
  stack.acquired.size = {columns, rows, int(slices.size())};
  const auto lost =
      std::find_if(slices.begin(), slices.end(), [](const PlacedSlice& s) { return !isPlaced(s.slice); });
  if (lost != slices.end()) {
    stack.acquired.calibrated = false;
    stack.warnings.push_back("Not calibrated: no measurements in mm, no orientation (" +
                             fileName(lost->path) + " has no valid " + missingPlace(lost->slice) +
                             "); shown with voxels of 1 mm.");
    return stack;
  }
  const Slice& first = slices[0].slice;
  stack.acquired.origin = *first.position;
  stack.acquired.patientFromVoxelStep[0] = first.orientation->row * first.spacing->x;
  stack.acquired.patientFromVoxelStep[1] = first.orientation->column * first.spacing->y;
  if (slices.size() == 1) {
    layOutSingle(slices[0], stack);
    return stack;
  }
  const std::vector<double> along = alongLine(slices);
  stack.acquired.patientFromVoxelStep[2] = lineDirection(slices) * (along.back() / double(slices.size() - 1));
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

std::string fileName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::string millimetres(double mm) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f", mm);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.ends_with('.')) s.pop_back();
  return s;
}

}  // namespace volumen::dicom
