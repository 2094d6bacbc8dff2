#include "ui/controller/find_saved.h"

#include <algorithm>
#include <iterator>

#include "io/curved.h"
#include "io/study/frame_series.h"
#include "io/study/study.h"
#include "ui/data/picture_stacks.h"

namespace volumen {

namespace {

bool hasName(const Series& series, const Series& saved) {
  const Series& name = sourceOf(saved);
  return series.id == name.id || (!name.seriesUid.empty() && series.seriesUid == name.seriesUid);
}

}  // namespace

std::vector<Series> allSeriesOf(const Study& study) {
  std::vector<Series> all = study.volumes;
  std::ranges::move(frameSeries(withPictureStacks(study)), std::back_inserter(all));
  std::ranges::move(frameSeriesOfPaths(study), std::back_inserter(all));
  return all;
}

const Series* findSaved(const std::vector<Series>& all, const SavedSeries& saved) {
  const Series* found = nullptr;
  for (const Series& series : all) {
    if (!hasName(series, saved.series) || proofOf(series) != saved.proof) continue;
    if (series.id == sourceOf(saved.series).id) return &series;
    if (!found) found = &series;
  }
  return found;
}

const Series* namesakeOf(const std::vector<Series>& all, const SavedSeries& saved) {
  const auto found =
      std::ranges::find_if(all, [&](const Series& series) { return hasName(series, saved.series); });
  return found == all.end() ? nullptr : &*found;
}

const DerivedObject* findSaved(const Study& study, const SavedObject& saved) {
  // The part after "#" identifies one of several copies.
  const std::string uid = saved.key.id.substr(0, saved.key.id.find('#'));
  const auto found = std::ranges::find_if(study.derived, [&](const DerivedObject& object) {
    return object.kind == saved.kind && (object.sopInstanceUid == uid || object.id == saved.key.id);
  });
  return found == study.derived.end() ? nullptr : &*found;
}

}  // namespace volumen
