#include "ui/data/picture_stacks.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "io/study/arrange.h"
#include "ui/data/frame_series.h"

namespace volumen {

namespace {

using SeriesName = std::pair<std::string, std::string>;  // UIDs of study and series

SeriesName nameOf(const SeriesIdentity& s) { return {s.studyUid, s.seriesUid}; }

// Whether each of its slices is a file of its own.
bool isOfSingleFrames(const Series& series) {
  const std::set<std::string> files(series.files.begin(), series.files.end());
  return files.size() == series.files.size() &&
         std::ranges::all_of(series.frames, [](int frame) { return frame == 0; });
}

bool mayBeStacked(const Series& series) {
  return series.modality != "PT" && frameCount(series) > 0 && opensAsPictures(series) &&
         series.splitBy.empty() && isOfSingleFrames(series);
}

std::set<SeriesName> stacksIn(const Study& study) {
  std::map<SeriesName, int> parts;
  std::set<SeriesName> others, stacks;
  for (const Series& series : study.volumes) {
    ++parts[nameOf(series)];
    if (!mayBeStacked(series)) others.insert(nameOf(series));
  }
  for (const Image& image : study.images)
    if (const auto known = parts.find(nameOf(image)); known != parts.end()) ++known->second;
  for (const auto& [name, count] : parts)
    if (count > 1 && !name.second.empty() && !others.contains(name)) stacks.insert(name);
  return stacks;
}

Image imageOf(const Series& series, int slice) {
  const auto n = std::size_t(slice);
  Image image;
  static_cast<SeriesIdentity&>(image) = series;
  const ProjectionView projection = projectionOf(series, slice);
  image.laterality = projection.laterality;
  image.viewPosition = projection.viewPosition;
  image.id = series.sopInstanceUids[n].empty() ? series.files[n] : series.sopInstanceUids[n];
  image.path = series.files[n];
  image.notVolume =
      "Pictures of one series that differ in size or direction are shown as a stack, not in 3D.";
  image.sopInstanceUid = series.sopInstanceUids[n];
  image.rows = series.acquired.size.y;
  image.columns = series.acquired.size.x;
  image.photometric = series.valueType;
  if (n < series.orders.size()) image.order = series.orders[n];
  image.isOfStack = true;
  return image;
}

// What a stack cannot say: files of it that were left out, but for those told already.
void tellUnread(const Series& series, Study& study) {
  for (const Unread& unread : series.unread) {
    const auto isIt = [&](const auto& told) { return told.path == unread.path; };
    if (!unread.beside && std::ranges::none_of(study.refused, isIt) &&
        std::ranges::none_of(study.other, isIt))
      study.refused.push_back(unread);
  }
}

}  // namespace

Study withPictureStacks(Study study) {
  const std::set<SeriesName> stacks = stacksIn(study);
  if (stacks.empty()) return study;
  const auto isStacked = [&](const Series& series) { return stacks.contains(nameOf(series)); };
  for (const Series& series : study.volumes) {
    if (!isStacked(series)) continue;
    for (int n = 0; n < frameCount(series); ++n) study.images.push_back(imageOf(series, n));
    tellUnread(series, study);
  }
  std::erase_if(study.volumes, isStacked);
  sortImages(study.images);
  return study;
}

}  // namespace volumen
