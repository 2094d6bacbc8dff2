#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/recipe/airways.h"
#include "viewer/recipe/scissors.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/numbers.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

using Places = std::vector<glm::dvec3>;

Neighbours neighboursOf(const StepInput& in) {
  const std::string& word = in.word("neighbours");
  return word == "corners" ? Neighbours::corners : word == "edges" ? Neighbours::edges : Neighbours::faces;
}

Parts partsOf(const StepInput& in) { return Parts(in.own(), neighboursOf(in), in.cancel); }

Result<BitMask> largest(const StepInput& in) { return partsOf(in).largest(std::size_t(in.number("count"))); }

// Surfaces separate voxels that share no face. A component that is large enough only by edges or corners
// would leave crumbs beside its body. If no face-connected piece is large enough, it is a thin oblique
// structure and stays whole.
Result<BitMask> islands(const StepInput& in) {
  const double voxels = in.number("leastMl") * 1000 / in.volume.geometry().voxelVolume();
  const auto least = std::int64_t(std::ceil(voxels - 1e-9));  // tolerates rounding
  const Neighbours neighbours = neighboursOf(in);
  const BitMask large = Parts(in.own(), neighbours, in.cancel).atLeast(least);
  if (neighbours == Neighbours::faces) return large;
  const BitMask bodies = Parts(large, Neighbours::faces, in.cancel).atLeast(least);
  const BitMask withBody = connected(large, voxelsOf(bodies), neighbours, in.cancel);
  return united(subtracted(large, withBody), bodies);
}

Result<BitMask> keep(const StepInput& in) { return partsOf(in).touched(in.voxelsAt("at")); }

Result<BitMask> remove(const StepInput& in) { return partsOf(in).untouched(in.voxelsAt("at")); }

// Returns the seed voxels: points, or the voxels of another segment.
std::vector<glm::ivec3> seedsOf(const StepInput& in) {
  std::vector<glm::ivec3> seeds = in.voxelsAt("at");
  if (!in.namesSegment("from")) return seeds;
  const std::vector<glm::ivec3> more = voxelsOf(in.segment("from"));
  seeds.insert(seeds.end(), more.begin(), more.end());
  return seeds;
}

Result<BitMask> connectedPart(const StepInput& in) {
  const std::vector<glm::ivec3> seeds = seedsOf(in);
  const double guard = in.number("leakGuardMm");
  return guard > 0 ? connectedBeyond(in.own(), seeds, neighboursOf(in), guard, in.cancel)
                   : connected(in.own(), seeds, neighboursOf(in), in.cancel);
}

Result<BitMask> copy(const StepInput& in) { return BitMask(in.segment("other")); }
Result<BitMask> add(const StepInput& in) { return united(in.own(), in.segment("other")); }

// Returns the other segment, grown by the margin.
BitMask nearOther(const StepInput& in) {
  const double margin = in.number("marginMm");
  return margin > 0 ? grown(in.segment("other"), margin, in.cancel) : in.segment("other");
}

Result<BitMask> subtract(const StepInput& in) { return subtracted(in.own(), nearOther(in)); }
Result<BitMask> intersect(const StepInput& in) { return intersected(in.own(), nearOther(in)); }
Result<BitMask> invert(const StepInput& in) { return inverted(in.own()); }

Result<BitMask> part(const StepInput& in) {
  const Parts parts(in.segment("other"), neighboursOf(in), in.cancel);
  std::vector<bool> chosen(parts.count());
  if (const double rank = in.number("rank"); rank <= double(parts.count()))
    chosen[std::size_t(rank) - 1] = true;
  return parts.mask(chosen);
}

Result<BitMask> trachea(const StepInput& in) { return tracheaOf(in.volume, in.segment("in"), in.cancel); }

Result<BitMask> airTree(const StepInput& in) {
  return airTreeOf(in.volume, seedsOf(in), {in.number("most"), in.number("mostMl")}, in.cancel);
}

}  // namespace

std::vector<StepKind> stepsOfParts() {
  using Need = StepField::Need;
  using enum StepField::Number;
  using enum StepKind::Use;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const StepField neighbours{
      "neighbours", "Touching by", "", std::string("faces"), {}, {"faces", "edges", "corners"}};
  const StepField at{"at", "At", "mm", Places{}, {}, {}, Need::yes}, perhapsAt{"at", "At", "mm", Places{}};
  const StepField from{"from", "About", "", std::string()},
      other{"other", "Other segment", "", std::string(), {}, {}, Need::yes},
      margin{"marginMm", "Margin", "mm", 0.0, {0, 100}};
  return {
      {"largest",
       "Keep largest",
       "its largest parts",
       {{"count", "How many", "", 1.0, {1, 1000}, {}, Need::no, whole}, neighbours},
       narrows,
       largest},
      {"islands",
       "Remove islands",
       "its parts of at least so many ml",
       {{"leastMl", "Smaller than", "ml", 1.0, {0, 1e6}}, neighbours},
       narrows,
       islands},
      {"keep", "Keep parts", "its parts at places", {at, neighbours}, narrows, keep},
      {"remove",
       "Remove parts",
       "its parts that are at none of these places",
       {at, neighbours},
       narrows,
       remove},
      {"connected",
       "Keep connected",
       "its part at places or about another segment; where it is thinner than twice the leak guard, nothing "
       "leaks through",
       {perhapsAt, from, {"leakGuardMm", "Leak guard", "mm", 0.0, {0, 100}}, neighbours},
       narrows,
       connectedPart},
      {"copy", "Copy", "the voxels of another segment", {other}, makes, copy},
      {"add", "Unite", "with another segment", {other}, changes, add},
      {"subtract",
       "Subtract",
       "without what lies in another segment, or within so many mm of it",
       {other, margin},
       narrows,
       subtract},
      {"intersect",
       "Intersect",
       "what lies in another segment, or within so many mm of it, too",
       {other, margin},
       narrows,
       intersect},
      {"scissors",
       "Cut by an outline",
       "without what lies inside an outline (or, to keep, outside) as it is seen from the first of two "
       "places to the second; in perspective the first is the eye; only so many mm before and behind it",
       {{"outline", "Outline", "mm", Places{}, {}, {}, Need::yes},
        {"sight", "Line of sight", "mm", Places{}, {}, {}, Need::yes},
        {"perspective", "Perspective", "", false},
        {"keep", "Keep what is inside", "", false},
        {"withinMm", "Within", "mm", unlimited, {0, unlimited}}},
       narrows,
       leftByScissors},
      {"invert", "Invert", "all other voxels", {}, changes, invert},
      {"part",
       "Part of another",
       "the part of another segment that is so many-th in size; none where there are fewer",
       {other, {"rank", "Rank", "", 2.0, {1, 1e6}, {}, Need::no, whole}, neighbours},
       makes,
       part},
      {"trachea",
       "Trachea",
       "a round slice of air near the middle of the body, in the upper half, that goes on for 3 cm",
       {{"in", "Inside", "", std::string(), {}, {}, Need::yes}},
       makes,
       trachea},
      {"airTree",
       "Air tree",
       "what is joined to places or another segment by values up to the highest threshold at which it is no "
       "larger than so many ml",
       {perhapsAt,
        from,
        {"most", "Up to", "value", -600.0, {-1e30, 1e30}},
        {"mostMl", "At most", "ml", 60.0, {0.1, 1e6}}},
       makes,
       airTree},
  };
}

}  // namespace volumen
