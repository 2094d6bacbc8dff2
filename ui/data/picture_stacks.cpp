#include "ui/data/picture_stacks.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "io/study/arrange.h"
#include "io/study/frame_series.h"

namespace volumen {

namespace {

using SeriesName = std::pair<std::string, std::string>;  // UIDs of study and series

SeriesName nameOf(const SeriesIdentity& s) { return {s.studyUid, s.seriesUid}; }

// Returns whether each of its slices is a file of its own.
bool isOfSingleFrames(const Series& series) {
  const std::set<std::string> files(series.files.begin(), series.files.end());
  return files.size() == series.files.size() &&
         std::ranges::all_of(series.frames, [](int frame) { return frame == 0; });
}

bool mayBeStacked(const Series& series) {
  return series.modality != "PT" && frameCount(series) > 0 && opensAsPictures(series) &&
         series.splitBy.empty() && isOfSingleFrames(series);
}

bool haveOnePatient(const SeriesIdentity& a, const SeriesIdentity& b) {
  return a.patientId == b.patientId && a.patientIdIssuer == b.patientIdIssuer &&
         a.patientName == b.patientName && a.patientBirthDate == b.patientBirthDate &&
         a.patientSex == b.patientSex;
}

// Returns whether slices have the same direction and size.
bool areAlike(const VoxelGeometry& a, const VoxelGeometry& b) {
  constexpr double nearEnough = 2e-3;  // relative to a step: directions are given with about six digits
  const auto isNear = [&](int axis) {
    const glm::dvec3 step = a.patientFromVoxelStep[axis];
    return glm::length(b.patientFromVoxelStep[axis] - step) <= nearEnough * glm::length(step);
  };
  return glm::ivec2(a.size) == glm::ivec2(b.size) && isNear(0) && isNear(1);
}

// The volumes and images of one series.
struct Parts {
  const SeriesIdentity* first;
  int count = 0;
  bool mayBeStacked = true, areInOneFrame = true;
  const Series* placed = nullptr;  // the first volume with a position
  bool differ = false;             // true if volumes with a position differ in direction or size
  std::set<std::string_view> instances = {};

  void add(const SeriesIdentity& part) {
    ++count;
    mayBeStacked = mayBeStacked && haveOnePatient(*first, part);
    areInOneFrame = areInOneFrame && part.frameOfReferenceUid == first->frameOfReferenceUid;
  }
  // Measurements identify the pictures of a stack by their UIDs.
  void addInstance(const std::string& uid) {
    mayBeStacked = mayBeStacked && !uid.empty() && instances.insert(uid).second;
  }
  void addPlaced(const Series& volume) {
    if (!placed) placed = &volume;
    differ = differ || !areAlike(placed->acquired, volume.acquired);
  }
  // A stack has one frame of reference for all pictures. Slices separated by a gap alone are no localizers.
  bool areStack() const { return count > 1 && mayBeStacked && (!placed || (differ && areInOneFrame)); }
};

std::set<SeriesName> stacksIn(const Study& study) {
  std::map<SeriesName, Parts> all;
  for (const Series& series : study.volumes) {
    if (series.seriesUid.empty()) continue;
    Parts& parts = all.try_emplace(nameOf(series), Parts{&series}).first->second;
    parts.add(series);
    parts.mayBeStacked = parts.mayBeStacked && mayBeStacked(series);
    if (series.acquired.calibrated) parts.addPlaced(series);
    for (const std::string& uid : series.sopInstanceUids) parts.addInstance(uid);
  }
  for (const Image& image : study.images) {
    const auto known = all.find(nameOf(image));
    if (known == all.end()) continue;
    known->second.add(image);
    known->second.addInstance(image.sopInstanceUid);
  }
  std::set<SeriesName> stacks;
  for (const auto& [name, parts] : all)
    if (parts.areStack()) stacks.insert(name);
  return stacks;
}

Image imageOf(const Series& series, int slice) {
  const auto n = std::size_t(slice);
  Image image;
  static_cast<SeriesIdentity&>(image) = series;
  const ProjectionView projection = projectionOf(series, slice);
  image.laterality = projection.laterality;
  image.viewPosition = projection.viewPosition;
  image.id = series.sopInstanceUids[n];
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

// Adds files left out of a series to the study, because a stack cannot report them, unless they are there.
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
