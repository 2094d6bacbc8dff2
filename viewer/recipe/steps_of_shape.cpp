#include "viewer/recipe/step_kinds.h"
#include "viewer/segment/between_slices.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/smoothing.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

using Shape = BitMask (*)(const BitMask&, double, const CancelToken&);

// A step by a radius.
template <Shape shape>
Result<BitMask> byRadius(const StepInput& in) {
  return shape(in.own(), in.number("radiusMm"), in.cancel);
}

Result<BitMask> gaussian(const StepInput& in) {
  return gaussianSmoothed(in.own(), in.number("sigmaMm"), in.cancel);
}

int axisOf(const StepInput& in) {
  const std::string& word = in.word("across");
  return word == "i" ? 0 : word == "j" ? 1 : word == "k" ? 2 : axisAlongPatient(in.volume.geometry());
}

Result<BitMask> fill(const StepInput& in) {
  if (in.word("across") == "volume") return holesFilled(in.own(), in.cancel);
  return holesFilledInSlices(in.own(), axisOf(in), in.cancel);
}

Result<BitMask> betweenSlices(const StepInput& in) {
  return filledBetweenSlices(in.own(), axisOf(in), in.cancel);
}

}  // namespace

std::vector<StepKind> stepsOfShape() {
  const auto radius = [](double mm) { return StepField{"radiusMm", "mm", mm, {0, 100}}; };
  return {
      {"grow", "with all within so many mm", {radius(1)}, byRadius<grown>},
      {"shrink", "without all within so many mm of its border", {radius(1)}, byRadius<shrunk>},
      {"open", "without what no ball of this radius fits in", {radius(1)}, byRadius<opened>},
      {"close", "with gaps that no ball of this radius fits in", {radius(1)}, byRadius<closed>},
      {"shell", "its outermost mm", {radius(2)}, byRadius<shell>},
      {"fill",
       "with what it encloses, in the volume or in slices across the patient or an axis of the grid",
       {{"across", "", std::string("volume"), {}, {"volume", "patient", "i", "j", "k"}}},
       fill},
      {"median", "where most voxels of a ball are in it", {radius(1.5)}, byRadius<medianSmoothed>},
      {"gaussian",
       "where it is more than half after a Gaussian",
       {{"sigmaMm", "mm", 1.0, {0, 100}}},
       gaussian},
      {"betweenSlices",
       "with the slices between those that are painted",
       {{"across", "", std::string("patient"), {}, {"patient", "i", "j", "k"}}},
       betweenSlices},
  };
}

}  // namespace volumen
