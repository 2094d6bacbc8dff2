#include "app/segment_numbers.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/code_json.h"
#include "app/command.h"
#include "app/text_table.h"
#include "viewer/measure/peak.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

Json known(bool is, double value) { return is ? Json(value) : Json(); }
Json place(glm::dvec3 p) { return {p.x, p.y, p.z}; }
Json place(glm::ivec3 p) { return {p.x, p.y, p.z}; }

Json formJson(const SegmentForm& f) {
  Json axes = Json::array();
  for (int n = 0; n < 3; ++n)
    axes.push_back({{"direction", place(f.axes[std::size_t(n)])}, {"mm", f.axisMm[n]}});
  return {{"surfaceMillilitres", f.surfaceMl},
          {"difference", f.surfaceMl - f.voxelMl},
          {"areaMm2", f.areaMm2},
          {"centroid", place(f.centroid)},
          {"box", {place(f.box.low), place(f.box.high)}},
          {"axes", axes},
          {"longestMm", f.longestMm},
          {"longestAt", {place(f.longestAt[0]), place(f.longestAt[1])}}};
}

Json segmentJson(const SegmentReport& n) {
  const SegmentValues& v = n.values;
  const bool has = v.voxels > 0;
  Json json{{"number", n.segment.number},
            {"name", n.segment.label},
            {"category", codeJson(n.segment.category)},
            {"type", codeJson(n.segment.type)},
            {"voxels", n.voxels},
            {"millilitres", known(n.millilitres.has_value(), n.millilitres.value_or(0))},
            {"mean", known(has, v.mean)},
            {"sd", known(has, v.sd)},
            {"min", known(has, v.min)},
            {"max", known(has, v.max)},
            {"median", known(has, v.median)},
            {"p10", known(has, v.p10)},
            {"p90", known(has, v.p90)},
            {"peak", known(n.peak.has_value(), n.peak.value_or(0))}};
  json["valueTimesMillilitres"] = known(has && n.millilitres, v.mean * n.millilitres.value_or(0));
  if (n.form) json.update(formJson(*n.form));
  return json;
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

Result<std::vector<SegmentReport>> numbersOf(const Segmented& segments, const Volume& volume,
                                             const CancelToken& cancel) {
  std::vector<SegmentReport> all;
  for (const Segment& segment : segments.segments) {
    const BitMask mask = maskOf(segments.labels, std::uint8_t(segment.number));
    SegmentReport numbers{segment, mask.count(), {}, valuesIn(mask, volume), {}, {}};
    const VoxelGeometry& grid = volume.geometry();
    if (grid.calibrated) numbers.millilitres = double(numbers.voxels) * grid.voxelVolume() / 1000;
    auto form = formOf(mask, cancel);
    if (!form) return form.error();
    numbers.form = *form;
    if (const auto peak = peakAbout(voxelsOf(mask), volume, cancel)) numbers.peak = peak->mean;
    if (cancel.cancelled()) return Error{"Cancelled."};
    all.push_back(std::move(numbers));
  }
  return all;
}

Json segmentsJson(const std::vector<SegmentReport>& all) {
  Json list = Json::array();
  for (const SegmentReport& n : all) list.push_back(segmentJson(n));
  return list;
}

std::string segmentsText(const std::vector<SegmentReport>& all, const std::string& unit) {
  const std::string of = unit.empty() ? "" : ", " + printable(unit);
  TextTable table(
      {"segment", "voxels", "ml", "ml, surface", "cm^2", "longest, mm", "mean" + of, "SD", "min", "max"});
  for (const SegmentReport& n : all) {
    const auto form = [&](double value) { return n.form ? numberText(value) : "-"; };
    const auto value = [&](double v) { return n.values.voxels > 0 ? numberText(v) : "-"; };
    const SegmentForm f = n.form.value_or(SegmentForm{});
    table.add({printable(n.segment.label), std::to_string(n.voxels),
               n.millilitres ? numberText(*n.millilitres) : "-", form(f.surfaceMl), form(f.areaMm2 / 100),
               form(f.longestMm), value(n.values.mean), value(n.values.sd), value(n.values.min),
               value(n.values.max)});
  }
  return table.text();
}

}  // namespace volumen
