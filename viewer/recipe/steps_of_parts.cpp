#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/recipe/airways.h"
#include "viewer/recipe/step_kinds.h"
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

Result<BitMask> islands(const StepInput& in) {
  const double mm3 = in.volume.geometry().voxelVolume();
  return partsOf(in).atLeast(std::int64_t(std::ceil(in.number("leastMl") * 1000 / mm3)));
}

Result<BitMask> keep(const StepInput& in) { return partsOf(in).touched(in.voxelsAt("at")); }

Result<BitMask> remove(const StepInput& in) { return partsOf(in).untouched(in.voxelsAt("at")); }

// The voxels to start from: places, or those of another segment.
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
Result<BitMask> subtract(const StepInput& in) { return subtracted(in.own(), in.segment("other")); }
Result<BitMask> intersect(const StepInput& in) { return intersected(in.own(), in.segment("other")); }
Result<BitMask> invert(const StepInput& in) { return inverted(in.own()); }

Result<BitMask> trachea(const StepInput& in) { return tracheaOf(in.volume, in.segment("in"), in.cancel); }

Result<BitMask> airTree(const StepInput& in) {
  return airTreeOf(in.volume, seedsOf(in), {in.number("most"), in.number("mostMl")}, in.cancel);
}

}  // namespace

std::vector<StepKind> stepsOfParts() {
  using Need = StepField::Need;
  const StepField neighbours{"neighbours", "", std::string("faces"), {}, {"faces", "edges", "corners"}};
  const StepField at{"at", "mm", Places{}, {}, {}, Need::yes}, perhapsAt{"at", "mm", Places{}};
  const StepField from{"from", "", std::string()}, other{"other", "", std::string(), {}, {}, Need::yes};
  return {
      {"largest", "its largest parts", {{"count", "", 1.0, {1, 1000}}, neighbours}, largest},
      {"islands",
       "its parts of at least so many ml",
       {{"leastMl", "ml", 1.0, {0, 1e6}}, neighbours},
       islands},
      {"keep", "its parts at places", {at, neighbours}, keep},
      {"remove", "its parts that are at none of these places", {at, neighbours}, remove},
      {"connected",
       "its part at places or about another segment; where it is thinner than twice the leak guard, nothing "
       "leaks through",
       {perhapsAt, from, {"leakGuardMm", "mm", 0.0, {0, 100}}, neighbours},
       connectedPart},
      {"copy", "the voxels of another segment", {other}, copy},
      {"add", "with another segment", {other}, add},
      {"subtract", "without another segment", {other}, subtract},
      {"intersect", "what another segment has, too", {other}, intersect},
      {"invert", "all other voxels", {}, invert},
      {"trachea",
       "a round slice of air near the middle of the body, in the upper half, that goes on for 3 cm",
       {{"in", "", std::string(), {}, {}, Need::yes}},
       trachea},
      {"airTree",
       "what is joined to places or another segment by values up to the highest threshold at which it is no "
       "larger than so many ml",
       {perhapsAt, from, {"most", "value", -600.0, {-1e30, 1e30}}, {"mostMl", "ml", 60.0, {0.1, 1e6}}},
       airTree},
  };
}

}  // namespace volumen
