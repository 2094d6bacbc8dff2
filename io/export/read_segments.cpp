#include "io/export/read_segments.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <string_view>
#include <unordered_set>

#include "io/export/label_image.h"
#include "io/export/label_table.h"
#include "io/export/seg_nrrd.h"
#include "io/files/image_file.h"
#include "io/files/write_volume.h"
#include "io/open.h"
#include "io/segmentation.h"

namespace volumen {

namespace {

// Fields of Slicer's ("Segment0_Name", "Segmentation_..."), or layers.
bool isSlicers(const ImageHeader& header) {
  return header.format == "NRRD" &&
         (header.data.volumes() > 1 || std::ranges::any_of(header.keyValues, [](const auto& field) {
            return field.first.starts_with("Segment");
          }));
}

bool hasSegments(const SegmentsFile& file) {
  return std::ranges::any_of(file.maps, [](const Segmented& map) { return !map.segments.empty(); });
}

Result<SegmentsFile> ofImage(const std::string& path, const VoxelGeometry& grid, const Progress& progress,
                             const CancelToken& cancel) {
  const auto header = readImageHeader(path, cancel);
  if (!header) return header.error();
  auto file =
      isSlicers(*header) ? readSegNrrd(path, progress, cancel) : readLabelImage(path, progress, cancel);
  if (!file) return file.error();
  if (!hasSegments(*file)) return Error{path + " holds no segments."};
  auto placed = onGrid(std::move(*file), grid);
  if (!placed) return Error{path + ": " + placed.message()};
  return placed;
}

// Pictures that it names are where it lies, whatever frame of reference their files say.
bool liesIn(const DerivedObject& object, const Series& series) {
  const std::string &own = object.frameOfReferenceUid, &frame = series.frameOfReferenceUid;
  const std::unordered_set<std::string_view> here(series.sopInstanceUids.begin(),
                                                  series.sopInstanceUids.end());
  return own.empty() || frame.empty() || own == frame ||
         std::ranges::any_of(object.pictures, [&](const ReferencedPicture& picture) {
           return here.contains(picture.sopInstanceUid);
         });
}

Result<SegmentsFile> ofObject(const std::string& path, const Series& series, const VoxelGeometry& grid,
                              const Progress& progress, const CancelToken& cancel) {
  const auto study = openFiles({path}, progress, cancel);
  if (!study) return study.error();
  if (!study->refused.empty()) return Error{path + ": " + study->refused.front().reason};
  const auto object = std::ranges::find(study->derived, DerivedKind::segmentation, &DerivedObject::kind);
  if (object == study->derived.end())
    return Error{path + " holds no segments: a DICOM segmentation, a .seg.nrrd or an image of labels does."};
  if (!liesIn(*object, series))
    return Error{path + " is of another frame of reference than the series: its places are none of it."};
  const auto segmentation = loadSegmentation(path);
  if (!segmentation) return segmentation.error();
  if (segmentation->segments.empty()) return Error{path + " holds no segments."};
  auto placed = onGrid(*segmentation, grid, cancel);
  if (!placed) return Error{path + ": " + placed.message()};
  return placed;
}

}  // namespace

Result<SegmentsFile> readSegments(const std::string& path, const Series& series, const VoxelGeometry& grid,
                                  const Progress& progress, const CancelToken& cancel) try {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return Error{path + " is no file that can be read."};
  return looksLikeImageFile(path) ? ofImage(path, grid, progress, cancel)
                                  : ofObject(path, series, grid, progress, cancel);
} catch (const std::bad_alloc&) {
  return Error{path + ": there is not enough memory for its segments."};
}

bool isNamedAsSegments(const std::string& path) {
  if (path.ends_with(".seg.nrrd")) return true;
  std::error_code none;
  return isVolumeFileName(path) && std::filesystem::exists(labelTableOf(path), none);
}

}  // namespace volumen
