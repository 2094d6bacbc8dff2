#include <cmath>
#include <limits>

#include "viewer/recipe/step_kinds.h"
#include "viewer/scene/automatic.h"
#include "viewer/segment/brush.h"
#include "viewer/segment/lesion.h"
#include "viewer/segment/range.h"
#include "viewer/segment/table.h"
#include "viewer/volume/histogram.h"

namespace volumen {

namespace {

using Places = std::vector<glm::dvec3>;
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr ValueRange anyValue{-unbounded, unbounded}, anyLength{0, 1000};

ValueRange rangeOf(const StepInput& in) { return {in.number("low"), in.number("high")}; }

Result<BitMask> range(const StepInput& in) { return voxelsInRange(in.volume, rangeOf(in)); }

// Returns the threshold with the largest between-class variance (Otsu 1979).
double otsuValue(const Volume& volume) {
  const Histogram h = histogram(volume, 1024);
  double all = 0, sum = 0;
  for (std::size_t n = 0; n < h.counts.size(); ++n)
    all += double(h.counts[n]), sum += double(n) * double(h.counts[n]);
  double below = 0, sumBelow = 0, best = -1;
  std::size_t at = 0;
  for (std::size_t n = 0; n + 1 < h.counts.size(); ++n) {
    below += double(h.counts[n]), sumBelow += double(n) * double(h.counts[n]);
    if (below == 0 || below == all) continue;
    const double apart = sumBelow / below - (sum - sumBelow) / (all - below);
    if (const double variance = below * (all - below) * apart * apart; variance > best)
      best = variance, at = n + 1;
  }
  return h.low + double(at) * h.binWidth();
}

Result<BitMask> otsu(const StepInput& in) {
  return voxelsInRange(in.volume, {in.number("times") * otsuValue(in.volume), unbounded});
}

Result<BitMask> ball(const StepInput& in) {
  BitMask mask(in.volume.geometry());
  for (const glm::dvec3& p : in.places("at"))
    addSpans(mask, ballStroke(mask.geometry(), p, p, in.number("radiusMm")));
  return mask;
}

// Paints with a ball drawn along the points.
Result<BitMask> paint(const StepInput& in) {
  BitMask stroke(in.volume.geometry());
  const Places& at = in.places("at");
  for (std::size_t n = 0; n < at.size(); ++n)
    addSpans(stroke, ballStroke(stroke.geometry(), at[n == 0 ? 0 : n - 1], at[n], in.number("radiusMm")));
  if (const ValueRange only = rangeOf(in); only != anyValue)
    stroke = intersected(std::move(stroke), voxelsInRange(in.volume, only));
  return in.flag("erase") ? subtracted(in.own(), stroke) : united(in.own(), stroke);
}

Result<BitMask> lesion(const StepInput& in) {
  const bool isShare = in.word("by") == "share";
  return lesionIn(in.segment("in"), in.volume, {in.number(isShare ? "share" : "value"), isShare}, in.cancel);
}

Result<BitMask> patient(const StepInput& in) {
  const VolumeAttributes& attributes = in.volume.attributes();
  if (attributes.modality != "CT" && !attributes.modality.empty())
    return Error{"values must be Hounsfield units: the series is " + attributes.modality + ", not CT"};
  if (waterOf(in.volume) != 0)
    return Error{"values must be Hounsfield units: the series lacks the rescale that makes them"};
  return patientMask(in.volume, in.cancel);
}

Result<BitMask> empty(const StepInput& in) { return BitMask(in.volume.geometry()); }

Result<BitMask> byHand(const StepInput& in) {
  return Error{"\"" + in.name() + "\" was painted, cut or opened, which no recipe can do again"};
}

}  // namespace

std::vector<StepKind> stepsOfValues() {
  using enum StepKind::Use;
  const StepField low{"low", "From", "value", -unbounded, anyValue},
      high{"high", "To", "value", unbounded, anyValue};
  const StepField at{"at", "At", "mm", Places{}, {}, {}, StepField::Need::yes};
  return {
      {"range", "Range", "the voxels of a range of values, both ends included", {low, high}, makes, range},
      {"otsu",
       "Otsu's threshold",
       "the voxels from a share of Otsu's threshold on",
       {{"times", "Times", "", 1.0, {0.01, 100}}},
       makes,
       otsu},
      {"ball",
       "Ball",
       "the voxels within so many mm of places",
       {at, {"radiusMm", "Radius", "mm", 10.0, anyLength}},
       makes,
       ball},
      {"paint",
       "Paint",
       "with (or without) what a ball covers that is drawn along places, of a range of values",
       {at, {"radiusMm", "Radius", "mm", 5.0, anyLength}, {"erase", "Erase", "", false}, low, high},
       changes,
       paint},
      {"lesion",
       "Lesion",
       "of another segment the part about its largest value, from a share of that value (or a value) on",
       {{"in", "Inside", "", std::string(), {}, {}, StepField::Need::yes},
        {"by", "By", "", std::string("share"), {}, {"share", "value"}},
        {"share", "Share", "", 0.41, {0, 1}},
        {"value", "Value", "value", 2.5, {-1e30, 1e30}}},
       makes,
       lesion},
      {"patient", "Patient", "the patient in a CT, lungs included, without the table", {}, makes, patient},
      {"empty", "Clear", "no voxels", {}, makes, empty},
      {byHandStep, "By hand", "what no recipe can do again: painted, cut, opened", {}, makes, byHand},
  };
}

}  // namespace volumen
