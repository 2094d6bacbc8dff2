#include <algorithm>
#include <limits>
#include <span>

#include "viewer/recipe/step_kinds.h"
#include "viewer/segment/between_slices.h"
#include "viewer/segment/grow_from_seeds.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/smoothing.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

using Shape = BitMask (*)(const BitMask&, double, const CancelToken&);

// Runs a step that takes a radius.
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

constexpr std::size_t mostTogether = 255;  // number of labels

// Returns the step's segment, those of "with" and the locked ones, each once.
std::vector<std::string> namesTogether(const StepInput& in, std::size_t& unlocked) {
  std::vector<std::string> names{in.name()};
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& name : more)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  add(in.names("with"));
  unlocked = names.size();
  add(in.names("locked"));
  return names;
}

// Gives the names labels 1, 2, ...; the first is the step's own segment.
LabelMap labelsTogether(const StepInput& in, std::span<const std::string> names) {
  LabelMap labels(in.volume.geometry());
  for (std::size_t n = 0; n < names.size(); ++n)
    labels = withLabel(labels, std::uint8_t(n + 1), n == 0 ? in.own() : in.mask(names[n]));
  return labels;
}

NamedMasks masksTogether(const LabelMap& labels, std::span<const std::string> names) {
  NamedMasks masks;
  for (std::size_t n = 0; n < names.size(); ++n) masks.emplace(names[n], maskOf(labels, std::uint8_t(n + 1)));
  return masks;
}

Result<NamedMasks> joint(const StepInput& in) {
  std::size_t unlocked = 0;
  const std::vector<std::string> names = namesTogether(in, unlocked);
  if (names.size() > mostTogether) return Error{"there are more than 255 segments"};
  std::vector<std::uint8_t> locked;
  for (std::size_t n = unlocked; n < names.size(); ++n) locked.push_back(std::uint8_t(n + 1));
  const LabelMap smoothed = jointSmoothed(labelsTogether(in, names), in.number("sigmaMm"), locked, in.cancel);
  return masksTogether(smoothed, std::span(names).first(unlocked));
}

// Returns the voxels that may be reached: those of "within", if given, that no locked segment holds.
BitMask openVoxels(const StepInput& in, std::span<const std::string> locked) {
  BitMask open = in.namesSegment("within") ? in.segment("within") : inverted(BitMask(in.volume.geometry()));
  for (const std::string& name : locked) open = subtracted(std::move(open), in.mask(name));
  return open;
}

Result<NamedMasks> growFromSeeds(const StepInput& in) {
  std::size_t unlocked = 0;
  const std::vector<std::string> names = namesTogether(in, unlocked);
  const std::span seeds = std::span(names).first(unlocked);
  if (seeds.size() > mostTogether) return Error{"there are more than 255 segments"};
  const LabelMap labels = labelsTogether(in, seeds);
  const BitMask within = openVoxels(in, std::span(names).subspan(unlocked));
  SeedGrowth growth;
  growth.within = &within;
  growth.marginMm = in.word("region") == "everywhere"
                        ? std::numeric_limits<double>::infinity()
                        : marginAboutSeeds(intersected(inverted(maskOf(labels, 0)), within));
  const Result<LabelMap> grown = grownFromSeeds(in.volume, labels, growth, in.cancel);
  if (!grown) return grown.error();
  return masksTogether(*grown, seeds);
}

}  // namespace

std::vector<StepKind> stepsOfShape() {
  using enum StepKind::Use;
  const auto radius = [](double mm, double most = 100) {
    return StepField{"radiusMm", "Radius", "mm", mm, {0, most}};
  };
  // Cost grows with the reach, and beyond this no shape is left.
  constexpr double mostSmoothing = 20;
  const StepField sigma{"sigmaMm", "Standard deviation", "mm", 1.0, {0, mostSmoothing}};
  const std::vector<std::string> none;
  return {
      {"grow", "Grow", "with all within so many mm", {radius(1)}, reshapes, byRadius<grown>},
      {"shrink",
       "Shrink",
       "without all within so many mm of its border",
       {radius(1)},
       narrows,
       byRadius<shrunk>},
      {"open", "Open", "without what no ball of this radius fits in", {radius(1)}, narrows, byRadius<opened>},
      {"close",
       "Close",
       "with gaps that no ball of this radius fits in",
       {radius(1)},
       reshapes,
       byRadius<closed>},
      {"shell", "Hollow", "its outermost mm", {radius(2)}, narrows, byRadius<shell>},
      {"fill",
       "Fill holes",
       "with what it encloses, in the volume or in slices across the patient or an axis of the grid",
       {{"across", "In", "", std::string("volume"), {}, {"volume", "patient", "i", "j", "k"}}},
       reshapes,
       fill},
      {"median",
       "Smooth (median)",
       "where most voxels of a ball are in it",
       {radius(1.5, mostSmoothing)},
       reshapes,
       byRadius<medianSmoothed>},
      {"gaussian", "Smooth", "where it is more than half after a Gaussian", {sigma}, reshapes, gaussian},
      {"joint",
       "Smooth all",
       "smoothed together with other segments, without gaps between them; locked ones stay",
       {{"with", "With", "", none}, sigma, {"locked", "Locked", "", none}},
       reshapes,
       nullptr,
       joint},
      {growFromSeedsStep,
       "Grow from seeds",
       "with what the path of the smallest changes of value joins to it rather than to the other segments, "
       "about all of them or everywhere; only within a segment, and not through locked ones",
       {{"with", "With", "", none, {}, {}, StepField::Need::yes},
        {"region", "Where", "", std::string("about"), {}, {"about", "everywhere"}},
        {"within", "Within", "", std::string()},
        {"locked", "Locked", "", none}},
       reshapes,
       nullptr,
       growFromSeeds},
      {"betweenSlices",
       "Fill between slices",
       "with the slices between those that are painted",
       {{"across", "Across", "", std::string("patient"), {}, {"patient", "i", "j", "k"}}},
       reshapes,
       betweenSlices},
  };
}

}  // namespace volumen
