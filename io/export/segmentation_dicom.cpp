#include "io/export/segmentation_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDateTime>
#include <algorithm>
#include <functional>
#include <iterator>
#include <new>
#include <optional>

#include "io/export/dicom_file.h"
#include "io/export/dicom_source.h"
#include "io/export/segmentation_elements.h"
#include "io/export/study_object.h"
#include "io/files/output_file.h"
#include "io/regular_file.h"
#include "io/study/series.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/listed_first.h"

namespace volumen {

namespace {

using MaskOf = std::function<WrittenMask(std::size_t segment)>;

SegmentationTags dated(SegmentationTags tags) {
  const QDateTime now = QDateTime::currentDateTime();
  if (tags.date.empty()) tags.date = now.toString(QStringLiteral("yyyyMMdd")).toStdString();
  if (tags.time.empty()) tags.time = now.toString(QStringLiteral("HHmmss")).toStdString();
  return tags;
}

Status checkSource(const Series& series, const VoxelGeometry& grid) {
  if (series.format != "DICOM" || series.curved)
    return Error{
        series.id +
        " comes from no DICOM files, whose pictures a DICOM segmentation must name; write .seg.nrrd."};
  if (!grid.calibrated) return Error{series.id + " does not say where its slices lie; write .seg.nrrd."};
  return checkNames(series);
}

Status writeObject(const SegmentationElements& elements, const SegmentationFrames& frames,
                   const std::string& path, const CancelToken& cancel) {
  DcmFileFormat file;
  DcmDataset& data = *file.getDataset();
  for (const DicomElements& group : elements.all()) put(group, data);
  const std::vector<std::uint8_t> bits = frames.bits().bytes();
  const OFCondition done =
      data.putAndInsertUint8Array(DCM_PixelData, bits.data(), static_cast<unsigned long>(bits.size()));
  if (done.bad()) return Error{"Cannot write " + path + ": " + done.text() + "."};
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  if (Status s = writeDicomFile(file, *out, path); !s) return s;
  if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
  return out->commit();
}

// Returns notes that name the acquired slices of uneven series that lie between grid slices.
std::vector<std::string> notesOfSlices(const SegmentationFrames& frames, const Series& series) {
  constexpr std::size_t mostNamed = 50;
  std::vector<std::string> names;
  for (const int slice : frames.slicesBetween()) {
    const auto n = std::size_t(slice);
    const bool hasMore = std::ranges::count(series.files, series.files[n]) > 1;
    names.push_back(fileName(series.files[n]) +
                    (hasMore ? " (frame " + std::to_string(series.frames[n] + 1) + ")" : std::string()));
  }
  if (names.empty()) return {};
  return {"Slices that have no voxels of their own, for what is drawn there is interpolated: " +
          listedFirst(names, mostNamed) + ". Each of their pixels has what the nearest voxel has."};
}

Result<std::vector<std::string>> writeSegments(const std::vector<Segment>& segments, const MaskOf& maskOf,
                                               const VoxelGeometry& grid, const Series& series,
                                               const SegmentationTags& tags, const std::string& path,
                                               const Progress& progress, const CancelToken& cancel) try {
  constexpr std::size_t mostBits = std::size_t(8) * 0xfffffffe;
  if (Status s = checkSource(series, grid); !s) return s.error();
  const auto source = readDicomSource(series, progress, cancel);
  if (!source) return source.error();
  if (Status s = checkPlaces(series, *source); !s) return s.error();
  SegmentationFrames frames(grid, *source, glm::ivec2(series.acquired.size));
  bool isInterpolated = false;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
    if (progress) progress("packing segments", n, segments.size());
    const WrittenMask mask = maskOf(n);
    frames.add(mask.drawn, mask.onSlices ? &*mask.onSlices : nullptr);
    isInterpolated = isInterpolated || mask.isInterpolated || !mask.onSlices;
    if (frames.bits().size() > mostBits)
      return Error{"The segments are more than the 4 GB that a DICOM file holds; write .seg.nrrd."};
  }
  if (frames.frames().empty())
    return Error{"Nothing is marked on the slices of " + series.id +
                 ": a DICOM segmentation without a pixel was not written."};
  const SegmentationTags said = dated(tags);
  const SegmentationElements elements(series, *source, frames, segments, said, sliceDistance(grid));
  if (Status s = writeObject(elements, frames, path, cancel); !s) return s.error();
  std::vector<std::string> notes = elements.notes();
  if (series.regular && isInterpolated)
    std::ranges::move(notesOfSlices(frames, series), std::back_inserter(notes));
  return notes;
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

}  // namespace

Result<std::vector<std::string>> writeSegmentationDicom(std::span<const Segmented> maps, const Series& series,
                                                        const SegmentationTags& tags, const std::string& path,
                                                        const Progress& progress, const CancelToken& cancel) {
  std::vector<Segment> segments;
  std::vector<const Segmented*> mapOf;
  for (const Segmented& map : maps)
    for (const Segment& segment : map.segments) {
      segments.push_back(segment);
      mapOf.push_back(&map);
    }
  const auto mask = [&](std::size_t n) { return writtenMask(*mapOf[n], segments[n].number); };
  const VoxelGeometry grid = maps.empty() ? series.acquired : maps.front().labels.geometry();
  return writeSegments(segments, mask, grid, series, tags, path, progress, cancel);
}

Result<std::vector<std::string>> writeSegmentationDicom(std::span<const SegmentVoxels> voxels,
                                                        const Series& series, const SegmentationTags& tags,
                                                        const std::string& path, const Progress& progress,
                                                        const CancelToken& cancel) {
  std::vector<Segment> segments;
  for (const SegmentVoxels& s : voxels) segments.push_back(s.segment);
  const VoxelGeometry grid = voxels.empty() ? series.acquired : voxels.front().mask.geometry();
  return writeSegments(
      segments, [&](std::size_t n) { return WrittenMask{voxels[n].mask}; }, grid, series, tags, path,
      progress, cancel);
}

}  // namespace volumen
