#include "io/export/export_segments.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "io/export/label_image.h"
#include "io/export/label_table.h"
#include "io/export/seg_nrrd.h"
#include "io/export/segmentation_dicom.h"
#include "io/export/surface_file.h"
#include "io/files/output_file.h"
#include "io/study/series.h"

namespace volumen {

namespace {

// All that a way of writing is given.
struct Export {
  const std::string& path;
  std::span<const Segmented> maps;
  const Series& series;
  const Progress& progress;
  const CancelToken& cancel;
  SurfaceWriting surfaces;
};
using Exported = Result<ExportedSegments>;

Exported asSegNrrd(const Export& e) {
  if (Status s = writeSegNrrd(e.maps, e.path, e.cancel); !s) return s.error();
  return ExportedSegments{{e.path}, {}};
}

Exported asDicom(const Export& e) {
  auto notes = writeSegmentationDicom(e.maps, e.series, {}, e.path, e.progress, e.cancel);
  if (!notes) return notes.error();
  return ExportedSegments{{e.path}, std::move(*notes)};
}

Exported asLabels(const Export& e) {
  if (e.maps.size() != 1)
    return Error{e.path +
                 ": an image of labels has one segment at each voxel, and these are in several maps, as what "
                 "overlaps is; .seg.nrrd and .dcm hold them."};
  if (Status s = writeLabelImage(e.maps.front(), e.path, e.progress, e.cancel); !s) return s.error();
  return ExportedSegments{{e.path}, {}};
}

// "scan-Bone.stl"; what a folder would read otherwise becomes "_".
std::string pathOf(const std::string& path, std::span<const Segmented> maps, const Segment& segment) {
  if (maps.size() == 1 && maps.front().segments.size() == 1) return path;
  const std::size_t ending = path.rfind('.');
  std::string name = segment.label;
  for (char& c : name)
    if (std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos ||
        static_cast<unsigned char>(c) < 32)
      c = '_';
  return path.substr(0, ending) + "-" + name + path.substr(ending);
}

// Of the segments that have voxels.
Result<std::vector<std::string>> surfacePaths(const std::string& path, std::span<const Segmented> maps) {
  std::vector<std::string> paths;
  for (const Segmented& map : maps) {
    const auto counts = labelCounts(map.labels);
    for (const Segment& segment : map.segments) {
      if (counts[std::size_t(segment.number)] == 0) continue;
      std::string one = pathOf(path, maps, segment);
      if (std::ranges::find(paths, one) != paths.end())
        return Error{one + ": two segments would be written to it; give them different names."};
      paths.push_back(std::move(one));
    }
  }
  return paths;
}

std::string toldOf(const std::string& path, const BitMask& mask, const Surface& surface) {
  char text[200];
  std::snprintf(text, sizeof text, "%zu triangles, %.4g ml inside (%.4g ml by voxels), %.4g cm^2",
                surface.triangles.size(), volumeOf(surface) / 1000,
                double(mask.count()) * mask.geometry().voxelVolume() / 1000, areaOf(surface) / 100);
  return path + ": " + text + ".";
}

std::string reductionTold(const std::string& path, const Surface& all, const Surface& fewer) {
  char text[200];
  std::snprintf(text, sizeof text, "reduced from %zu triangles and %.4g ml, at most %.2g mm off them",
                all.triangles.size(), volumeOf(all) / 1000, deviation(fewer, all).largest);
  return path + ": " + text + ".";
}

Status addSurface(const Export& e, const Segmented& map, const Segment& segment, ExportedSegments& done) {
  const BitMask mask = maskOf(map.labels, std::uint8_t(segment.number));
  const std::string path = pathOf(e.path, e.maps, segment);
  if (mask.empty()) {
    done.notes.push_back(segment.label + " has no voxels, and no surface.");
    return {};
  }
  const Result<Surface> all = surfaceOf(occupancyOf(mask, surfaceSigma, e.cancel), e.cancel);
  if (!all) return all.error();
  const double byMm = e.surfaces.reducedByMm;
  const std::optional<Surface> fewer = byMm > 0 ? std::optional(reduced(*all, byMm, e.cancel)) : std::nullopt;
  const Surface& surface = fewer ? *fewer : *all;
  if (Status s = writeSurface(surface, path, e.cancel); !s) return s;
  done.notes.push_back(toldOf(path, mask, surface));
  if (fewer) done.notes.push_back(reductionTold(path, *all, surface));
  done.files.push_back(path);
  return {};
}

// None is written where one of them cannot be.
Exported asSurfaces(const Export& e) {
  const auto paths = surfacePaths(e.path, e.maps);
  if (!paths) return paths.error();
  if (paths->empty()) return Error{e.path + " is not written: no segment has voxels."};
  for (const std::string& path : *paths)
    if (auto file = OutputFile::create(path); !file) return file.error();
  ExportedSegments done;
  for (const Segmented& map : e.maps)
    for (const Segment& segment : map.segments)
      if (Status s = addSurface(e, map, segment, done); !s) return s.error();
  return done;
}

// A row a kind of file.
struct Row {
  SegmentFormat format;
  Exported (*write)(const Export&);
};
constexpr Row formatRows[] = {
    {{".seg.nrrd", "Segmentations of 3D Slicer"}, asSegNrrd},
    {{".dcm", "DICOM segmentations"}, asDicom},
    {{".stl", "Surfaces", true}, asSurfaces},
    {{".ply", "Surfaces", true}, asSurfaces},
    {{".obj", "Surfaces", true}, asSurfaces},
    {{".nii.gz", "Images of labels"}, asLabels},
    {{".mha", "Images of labels"}, asLabels},
};

Result<const Row*> rowOf(const std::string& path) {
  std::string lower = path, endings;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const Row& row : formatRows) {
    if (lower.ends_with(row.format.ending)) return &row;
    endings.append(endings.empty() ? "" : ", ").append(row.format.ending);
  }
  return Error{path + ": segments are written as " + endings + "."};
}

// The Error: a file to be written is one of the series.
Status checkApartFrom(const Series& series, std::span<const std::string> written) {
  std::error_code none;
  for (const std::string& path : written) {
    if (!std::filesystem::exists(path, none)) continue;
    for (const std::string& file : series.files)
      if (std::filesystem::equivalent(path, file, none))
        return Error{path + " is not written: it is a file of the series."};
  }
  return {};
}

}  // namespace

std::span<const SegmentFormat> segmentFormats() {
  static const std::vector<SegmentFormat> formats = [] {
    std::vector<SegmentFormat> all;
    for (const Row& row : formatRows) all.push_back(row.format);
    return all;
  }();
  return formats;
}

Result<const SegmentFormat*> segmentFormatOf(const std::string& path) {
  const Result<const Row*> row = rowOf(path);
  if (!row) return row.error();
  return &(*row)->format;
}

Result<std::vector<std::string>> filesOfExport(const std::string& path, std::span<const Segmented> maps) {
  const Result<const Row*> row = rowOf(path);
  if (!row) return row.error();
  if ((*row)->format.isSurface) return surfacePaths(path, maps);
  std::vector<std::string> files{path};
  if ((*row)->write == asLabels) files.push_back(labelTableOf(path));
  return files;
}

Result<ExportedSegments> exportSegments(const std::string& path, std::span<const Segmented> maps,
                                        const Series& series, const Progress& progress,
                                        const CancelToken& cancel, SurfaceWriting surfaces) {
  const Result<const Row*> row = rowOf(path);
  if (!row) return row.error();
  const auto written = filesOfExport(path, maps);
  if (!written) return written.error();
  if (Status s = checkApartFrom(series, *written); !s) return s.error();
  return (*row)->write({path, maps, series, progress, cancel, surfaces});
}

}  // namespace volumen
