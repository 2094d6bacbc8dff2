#include "ui/data/frame_series.h"
#include "io/study/study.h"
#include "viewer/slice/plane.h"

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

namespace fs = std::filesystem;

bool belongsTo(const Image& image, const Series& series) {
  return !image.seriesUid.empty() && image.seriesUid == series.seriesUid && image.studyUid == series.studyUid;
}

// The folder that holds two places, or folders that hold them.
std::string folderOfBoth(const fs::path& a, const fs::path& b) {
  const auto [inA, inB] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  fs::path both;
  for (auto part = a.begin(); part != inA; ++part) both /= *part;
  return both.string();
}

Series seriesOf(const Image& image) {
  Series series;
  static_cast<SeriesIdentity&>(series) = image;
  // A volume may be called by the series alone.
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
  // How one clip is played says nothing of several.
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

}  // namespace

std::vector<Series> frameSeries(const Study& study) {
  std::vector<Series> all;
  for (const Image& image : study.images) {
    auto series = std::ranges::find_if(all, [&](const Series& known) { return belongsTo(image, known); });
    if (series == all.end()) series = all.insert(all.end(), seriesOf(image));
    addFrames(*series, image);
  }
  for (Series& series : all) setProjections(series, std::vector<ProjectionView>(series.projections));
  return all;
}

int frameCount(const Series& series) { return series.format == "DICOM" ? int(series.files.size()) : 0; }

bool opensAsFrames(const Series& series) {
  const bool isPlaceless = series.acquired.size.z == 1 && !series.acquired.calibrated;
  return !series.notVolume.empty() || (isPlaceless && frameCount(series) > 0);
}

bool isUsefulVolume(const Series& series) {
  constexpr int fewest = 4;
  constexpr double mostThicknesses = 2, mostMm = 10, mostPixels = 2;  // from slice to slice
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
  return !series.projections.empty() && !isPlaced &&
         std::ranges::find(modalities, series.modality) != std::end(modalities);
}

bool opensAsPictures(const Series& series) {
  const bool isUseful = isUsefulVolume(series) && !isOfProjections(series);
  return opensAsFrames(series) || (!isUseful && frameCount(series) > 0);
}

}  // namespace volumen
