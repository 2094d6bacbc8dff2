#include "io/export/read_segments.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <string_view>
#include <unordered_set>

#include "io/export/contour_segments.h"
#include "io/export/label_image.h"
#include "io/export/label_table.h"
#include "io/export/seg_nrrd.h"
#include "io/files/image_file.h"
#include "io/files/write_volume.h"
#include "io/open.h"
#include "io/segmentation.h"
#include "viewer/segment/names_and_colours.h"
#include "viewer/volume/listed_first.h"

namespace volumen {

namespace {

// True for files with Slicer's fields ("Segment0_Name", "Segmentation_...") or with layers.
bool isSlicers(const ImageHeader& header) {
  return header.format == "NRRD" &&
         (header.data.volumes() > 1 || std::ranges::any_of(header.keyValues, [](const auto& field) {
            return field.first.starts_with("Segment");
          }));
}

bool hasSegments(const SegmentsFile& file) {
  return std::ranges::any_of(file.maps, [](const Segmented& map) { return !map.segments.empty(); });
}

// Returns the segments on the grid of the image.
Result<SegmentsFile> segmentsOfImage(const std::string& path, const Progress& progress,
                                     const CancelToken& cancel) {
  const auto header = readImageHeader(path, cancel);
  if (!header) return header.error();
  auto file =
      isSlicers(*header) ? readSegNrrd(path, progress, cancel) : readLabelImage(path, progress, cancel);
  if (!file) return file;
  if (!hasSegments(*file)) return Error{path + " holds no segments."};
  std::ranges::copy(header->data.files, std::back_inserter(file->files));
  return file;
}

std::vector<std::string> picturesOf(const DerivedObject& object) {
  std::vector<std::string> uids;
  for (const ReferencedPicture& picture : object.pictures) uids.push_back(picture.sopInstanceUid);
  return uids;
}

bool haveOneInCommon(const std::vector<std::string>& pictures,
                     const std::vector<std::string>& otherPictures) {
  const std::unordered_set<std::string_view> others(otherPictures.begin(), otherPictures.end());
  return std::ranges::any_of(pictures, [&](const std::string& uid) { return others.contains(uid); });
}

// Returns true if two objects lie in one space. Objects that reference the same images do, even if their
// frames of reference differ.
bool areTogether(const std::string& frame, const std::vector<std::string>& pictures,
                 const std::string& otherFrame, const std::vector<std::string>& otherPictures) {
  return frame.empty() || otherFrame.empty() || frame == otherFrame ||
         haveOneInCommon(pictures, otherPictures);
}

Result<DerivedObject> objectOf(const std::string& path, const Progress& progress, const CancelToken& cancel) {
  const auto study = openFiles({path}, progress, cancel);
  if (!study) return study.error();
  if (!study->refused.empty()) return Error{path + ": " + study->refused.front().reason};
  for (const DerivedObject& object : study->derived)
    if (object.kind == DerivedKind::segmentation || object.kind == DerivedKind::contours) return object;
  return Error{path +
               " holds no segments: a DICOM segmentation, a structure set, a .seg.nrrd or an image of labels "
               "does."};
}

Result<Segmentation> segmentationOf(const std::string& path, glm::ivec2 pictures = glm::ivec2(0)) {
  auto segmentation = loadSegmentation(path, pictures);
  if (segmentation && segmentation->segments.empty()) return Error{path + " holds no segments."};
  return segmentation;
}

Result<SegmentsFile> segmentsOfObject(const std::string& path, const Progress& progress,
                                      const CancelToken& cancel) {
  const auto object = objectOf(path, progress, cancel);
  if (!object) return object.error();
  if (object->kind == DerivedKind::contours)
    return Error{path +
                 " holds contours, which have no grid of their own: name the series that they are of."};
  const auto segmentation = segmentationOf(path);
  if (!segmentation) return segmentation.error();
  const auto grid = gridOf(*segmentation);
  if (!grid) return Error{path + ": " + grid.message()};
  SegmentsFile file{.maps = segmentedOf(*segmentation, *grid, cancel), .notes = segmentation->notes};
  if (cancel.cancelled()) return Error{"Cancelled."};
  file.frameOfReferenceUid = object->frameOfReferenceUid;
  file.pictures = picturesOf(*object);
  return file;
}

Result<SegmentsFile> placedImage(const std::string& path, const VoxelGeometry& grid, const Progress& progress,
                                 const CancelToken& cancel) {
  auto file = segmentsOfImage(path, progress, cancel);
  if (!file) return file;
  auto placed = onGrid(std::move(*file), grid);
  if (!placed) return Error{path + ": " + placed.message()};
  return placed;
}

Result<SegmentsFile> placedContours(const std::string& path, const VoxelGeometry& grid,
                                    const CancelToken& cancel, const AcquiredSlices& slices) {
  if (!grid.calibrated)
    return Error{path + ": the position of the series is not known, so contours cannot be placed in it."};
  const auto set = loadContours(path);
  if (!set) return set.error();
  const Segmentation filled = filledContours(*set, grid, slices.places, cancel);
  if (cancel.cancelled()) return Error{"Cancelled."};
  if (filled.frames.empty())
    return Error{path + " holds no closed contour that encloses a pixel of the series."};
  auto placed = onGrid(filled, grid, cancel, slices);
  if (!placed) return Error{path + ": " + placed.message()};
  return placed;
}

std::string rowsText(glm::ivec2 size) {
  return std::to_string(size.y) + " rows and " + std::to_string(size.x) + " columns";
}

Result<SegmentsFile> placedObject(const std::string& path, const Series& series, const VoxelGeometry& grid,
                                  const Progress& progress, const CancelToken& cancel,
                                  const AcquiredSlices& slices) {
  const auto object = objectOf(path, progress, cancel);
  if (!object) return object.error();
  if (!areTogether(object->frameOfReferenceUid, picturesOf(*object), series.frameOfReferenceUid,
                   series.sopInstanceUids))
    return Error{path + " is of another frame of reference than the series: its places are none of it."};
  if (object->kind == DerivedKind::contours) return placedContours(path, grid, cancel, slices);
  const glm::ivec2 pictures =
      haveOneInCommon(picturesOf(*object), series.sopInstanceUids) ? series.acquired.size : glm::ivec3(0);
  const auto segmentation = segmentationOf(path, pictures);
  if (!segmentation) return segmentation.error();
  auto placed = onGrid(*segmentation, grid, cancel, slices);
  if (!placed) return Error{path + ": " + placed.message()};
  if (pictures != glm::ivec2(0) && pictures != segmentation->size)
    placed->notes.push_back("The frames of " + path + " have " + rowsText(segmentation->size) +
                            "; the pictures that it names have " + rowsText(pictures) + ".");
  return placed;
}

// Makes names unique and adds missing colours.
SegmentsFile toldApart(SegmentsFile file, const std::string& path) {
  const NamesGiven given = addNames(file.maps);
  if (!given.unnamed.empty())
    file.notes.push_back(path + ": what has no name is called " + listedFirst(given.unnamed) + ".");
  if (!given.alike.empty())
    file.notes.push_back(path + ": what has the name of another segment is called " +
                         listedFirst(given.alike) + ".");
  addColours(file.maps);
  return file;
}

// Reads an image or a DICOM object, depending on the contents of the file.
template <class OfImage, class OfObject>
Result<SegmentsFile> readAs(const std::string& path, const OfImage& ofImage, const OfObject& ofObject) try {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return Error{path + " does not exist."};
  if (!std::filesystem::is_regular_file(path, none)) return Error{path + " is no file that can be read."};
  Result<SegmentsFile> file = looksLikeImageFile(path) ? ofImage() : ofObject();
  if (!file) return file;
  file->files.push_back(path);
  return toldApart(std::move(*file), path);
} catch (const std::bad_alloc&) {
  return Error{path + ": there is not enough memory for its segments."};
}

}  // namespace

Result<SegmentsFile> readSegments(const std::string& path, const Series& series, const VoxelGeometry& grid,
                                  const Progress& progress, const CancelToken& cancel,
                                  const AcquiredSlices& slices) {
  return readAs(
      path, [&] { return placedImage(path, grid, progress, cancel); },
      [&] { return placedObject(path, series, grid, progress, cancel, slices); });
}

Result<SegmentsFile> readSegments(const std::string& path, const Progress& progress,
                                  const CancelToken& cancel) {
  return readAs(
      path, [&] { return segmentsOfImage(path, progress, cancel); },
      [&] { return segmentsOfObject(path, progress, cancel); });
}

bool areOfOneSpace(const SegmentsFile& a, const SegmentsFile& b) {
  return areTogether(a.frameOfReferenceUid, a.pictures, b.frameOfReferenceUid, b.pictures);
}

bool isNamedAsSegments(const std::string& path) {
  if (path.ends_with(".seg.nrrd")) return true;
  std::error_code none;
  return isVolumeFileName(path) && std::filesystem::exists(labelTableOf(path), none);
}

}  // namespace volumen
