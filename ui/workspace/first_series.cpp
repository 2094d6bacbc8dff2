#include "ui/workspace/first_series.h"

#include <algorithm>

#include "io/study/frame_series.h"
#include "io/study/study.h"
#include "ui/workspace/link_text.h"

namespace volumen {

namespace {

bool isSmaller(const Series* a, const Series* b) {
  return a->acquired.voxelCount() < b->acquired.voxelCount();
}

}  // namespace

const Series* ctUnder(const Workspace& workspace, const Series& pet, const std::vector<const Series*>& open) {
  const Series* found = nullptr;
  for (const Series* series : open)
    if (series->modality == "CT" && series->studyUid == pet.studyUid &&
        (!found || isSmaller(found, series)) && whyNotOverlaid(workspace, *series, pet).isEmpty())
      found = series;
  return found;
}

const Series* petOver(const Workspace& workspace, const Series& ct, const Study& study,
                      const std::vector<const Series*>& open) {
  for (const Series& series : study.volumes) {
    const bool isPet = series.modality == "PT" && isUsefulVolume(series);
    const Series* under = isPet ? ctUnder(workspace, series, open) : nullptr;
    if (under && keyOf(*under) == keyOf(ct)) return &series;
  }
  return nullptr;
}

std::optional<Series> firstSeries(const Workspace& workspace, const Study& study,
                                  const std::vector<const Series*>& open, const std::string& seriesUid) {
  const bool isNamed = !seriesUid.empty();
  const auto isMeant = [&](const SeriesIdentity& s) { return !isNamed || s.seriesUid == seriesUid; };
  const Series* first = nullptr;
  for (const Series& series : study.volumes)
    if (isMeant(series) && (!first || isSmaller(first, &series))) first = &series;
  const std::vector<Series> frames = frameSeries(study);
  if (!first) {
    const auto found = std::ranges::find_if(frames, isMeant);
    return found == frames.end() ? std::nullopt : std::optional(*found);
  }
  if (isNamed) return *first;
  if (const Series* stack = largerStack(*first, frames)) return *stack;
  const Series* pet = workspace.focus < firstComparedId ? petOver(workspace, *first, study, open) : nullptr;
  return pet ? *pet : *first;
}

}  // namespace volumen
