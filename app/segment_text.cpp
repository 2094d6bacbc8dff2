#include "app/segment_text.h"

#include <cstdio>

#include "app/command.h"
#include "app/text_table.h"

namespace volumen {

namespace {

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string numberText(const std::optional<double>& value) { return value ? numberText(*value) : "-"; }

}  // namespace

std::string segmentsText(const std::vector<SegmentReport>& all, const ValueScale& scale, bool withSurfaces) {
  const std::string of = scale.unit.empty() ? "" : ", " + printable(scale.unit);
  std::vector<std::string> heads{"segment", "voxels", "ml"};
  if (withSurfaces) heads.insert(heads.end(), {"ml, surface", "cm^2", "longest, mm"});
  heads.insert(heads.end(), {"mean" + of, "SD", "min", "max"});
  TextTable table(heads);
  for (const SegmentReport& r : all) {
    const auto form = [&](double value) { return r.form ? numberText(value) : "-"; };
    const auto value = [&](double v) { return r.values.voxels > 0 ? numberText(v * scale.factor) : "-"; };
    const SegmentForm f = r.form.value_or(SegmentForm{});
    std::vector<std::string> row{printable(r.segment.label), std::to_string(r.voxels),
                                 numberText(r.millilitres)};
    if (withSurfaces) row.insert(row.end(), {form(f.surfaceMl), form(f.areaMm2 / 100), form(f.longestMm)});
    row.insert(row.end(),
               {value(r.values.mean), value(r.values.sd), value(r.values.min), value(r.values.max)});
    table.add(row);
  }
  return table.text();
}

std::string comparedText(const std::vector<ComparedSegments>& all) {
  TextTable table({"first", "second", "Dice", "difference, ml", "Hausdorff, mm", "95 %, mm", "mean, mm"});
  for (const ComparedSegments& c : all) {
    const auto& d = c.alike.distances;
    const auto distance = [&](double mm) { return d ? numberText(mm) : "-"; };
    table.add({printable(c.first), printable(c.second), numberText(c.alike.dice),
               numberText(c.alike.differenceMl), distance(d ? d->largest : 0), distance(d ? d->p95 : 0),
               distance(d ? d->mean : 0)});
  }
  return table.text();
}

}  // namespace volumen
