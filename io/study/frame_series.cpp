#include "io/study/frame_series.h"
#include "io/study/study.h"
#include "viewer/slice/plane.h"

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace volumen {

namespace {

namespace fs = std::filesystem;

using Pictures = std::vector<const Image*>;

// Returns the innermost folder that holds both paths.
std::string folderOfBoth(const fs::path& a, const fs::path& b) {
  const auto [inA, inB] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  fs::path both;
  for (auto part = a.begin(); part != inA; ++part) both /= *part;
  return both.string();
}

Series seriesOf(const Image& image) {
  Series series;
  static_cast<SeriesIdentity&>(series) = image;
  // The id of a volume may be the series UID alone.
  series.id = (image.seriesUid.empty() ? image.id : image.seriesUid) + "#frames";
  series.path = image.path;
  series.format = "DICOM";
  series.valueType = image.photometric;
  series.notVolume = image.notVolume;
  series.acquired = {.size = {image.columns, image.rows, 0}, .calibrated = false};
  series.cine = image.cine;
  return series;
}

void addFrames(Series& series, const Image& image) {
  if (!series.files.empty()) series.path = folderOfBoth(series.path, fs::path(image.path).parent_path());
  // The frame times of one clip do not hold for several.
  if (!series.files.empty()) series.cine.frameTimesMs.clear();
  if (!series.lossyRatio) series.lossyRatio = image.lossyRatio;
  for (int frame = 0; frame < image.frames; ++frame) {
    series.files.push_back(image.path);
    series.frames.push_back(frame);
    series.sopInstanceUids.push_back(image.sopInstanceUid);
    series.projections.push_back({image.laterality, image.viewPosition});
  }
  series.acquired.size.z = int(series.files.size());
}

// Returns the pictures of each series, in study order. Each file without a series stands alone.
std::vector<Pictures> picturesOfEach(const Study& study) {
  std::vector<Pictures> all;
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> known;
  for (const Image& image : study.images) {
    if (image.seriesUid.empty()) {
      all.push_back({&image});
      continue;
    }
    const auto [at, isNew] = known.try_emplace({image.studyUid, image.seriesUid}, all.size());
    if (isNew) all.emplace_back();
    all[at->second].push_back(&image);
  }
  return all;
}

// `pictures` is not empty.
Series stackOf(const Pictures& pictures) {
  Series series = seriesOf(*pictures.front());
  for (const Image* image : pictures) addFrames(series, *image);
  setProjections(series, std::vector<ProjectionView>(series.projections));
  return series;
}

// Returns nothing if all of them were volumes.
std::optional<Series> stackOfPaths(Pictures pictures) {
  std::erase_if(pictures, [](const Image* image) { return image->isOfStack; });
  return pictures.empty() ? std::nullopt : std::optional(stackOf(pictures));
}

Series stackInOrder(Pictures pictures) {
  const std::optional<Series> ofPaths = stackOfPaths(pictures);
  std::ranges::stable_sort(pictures, [](const Image* a, const Image* b) {
    return std::tie(a->order, a->sopInstanceUid) < std::tie(b->order, b->sopInstanceUid);
  });
  Series series = stackOf(pictures);
  for (const Image* image : pictures) {
    series.acquired.size.x = std::max(series.acquired.size.x, image->columns);
    series.acquired.size.y = std::max(series.acquired.size.y, image->rows);
  }
  // One id must name the same frames in every session.
  if (series != ofPaths) series.id = pictures.front()->seriesUid + "#pictures";
  return series;
}

}  // namespace

std::vector<Series> frameSeries(const Study& study) {
  std::vector<Series> all;
  for (const Pictures& pictures : picturesOfEach(study)) all.push_back(stackInOrder(pictures));
  return all;
}

std::vector<Series> frameSeriesOfPaths(const Study& study) {
  std::vector<Series> all;
  for (const Pictures& pictures : picturesOfEach(study))
    if (std::optional<Series> series = stackOfPaths(pictures)) all.push_back(std::move(*series));
  return all;
}

int frameCount(const Series& series) { return series.format == "DICOM" ? int(series.files.size()) : 0; }

bool opensAsFrames(const Series& series) {
  const bool isPlaceless = series.acquired.size.z == 1 && !series.acquired.calibrated;
  return !series.notVolume.empty() || (isPlaceless && frameCount(series) > 0);
}

bool isUsefulVolume(const Series& series) {
  constexpr int fewest = 4;
  constexpr double mostThicknesses = 2, mostMm = 10, mostPixels = 2;  // limits of the distance between slices
  if (!series.notVolume.empty() || series.acquired.size.z < fewest) return false;
  if (!series.acquired.calibrated) return true;
  const glm::dmat3& L = series.acquired.patientFromVoxelStep;
  const double apart = sliceDistance(series.acquired);
  if (apart <= mostPixels * std::max(glm::length(L[0]), glm::length(L[1]))) return true;
  return apart <= mostMm && (series.sliceThickness <= 0 || apart <= mostThicknesses * series.sliceThickness);
}

bool isOfProjections(const Series& series) {
  constexpr const char* modalities[] = {"MG", "CR", "DX", "RG", "PX", "IO"};
  const bool isPlaced = series.acquired.calibrated && series.notVolume.empty();
  const bool areSeveral =
      !series.projections.empty() || (frameCount(series) > 1 && series.files.front() != series.files.back());
  return areSeveral && !isPlaced && std::ranges::find(modalities, series.modality) != std::end(modalities);
}

bool areMadeOneByOne(const Series& series) {
  constexpr const char* modalities[] = {"CR", "DX", "IO", "MG", "OT", "PX", "RF", "RG", "US", "XA"};
  return !series.acquired.calibrated &&
         std::ranges::find(modalities, series.modality) != std::end(modalities);
}

bool opensAsPictures(const Series& series) {
  const bool isUseful = isUsefulVolume(series) && !isOfProjections(series) && !areMadeOneByOne(series);
  return opensAsFrames(series) || (!isUseful && frameCount(series) > 0);
}

const Series* largerStack(const Series& series, const std::vector<Series>& frames) {
  if (!opensAsPictures(series)) return nullptr;
  const auto isLarger = [&](const Series& stack) { return frameCount(stack) > frameCount(series); };
  const auto found = std::ranges::find_if(frames, isLarger);
  return found == frames.end() ? nullptr : &*found;
}

}  // namespace volumen
