#include "io/export/export_segments.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>

#include "io/export/label_image.h"
#include "io/export/label_table.h"
#include "io/export/seg_nrrd.h"
#include "io/export/segmentation_dicom.h"
#include "io/export/surface_file.h"
#include "io/files/output_file.h"
#include "io/study/series.h"
#include "viewer/volume/free_name.h"
#include "viewer/volume/listed_first.h"

namespace volumen {

namespace {

// Arguments of all writers.
struct Export {
  const std::string& path;
  std::span<const Segmented> maps;
  const Series& series;
  const Progress& progress;
  const CancelToken& cancel;
  const SurfaceWriting& surfaces;
};
using Exported = Result<ExportedSegments>;

Exported asSegNrrd(const Export& e) {
  if (Status s = writeSegNrrd(e.maps, e.path, e.cancel, identityFields(e.series)); !s) return s.error();
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
  ExportedSegments done{{e.path}, {}};
  if (const auto changed = namesChangedInTable(e.maps.front().segments); !changed.empty())
    done.notes.push_back("Names in " + labelTableOf(e.path) +
                         " have one line without quotation marks: " + listedFirst(changed) + ".");
  return done;
}

// Returns a name as part of a file name: characters with a meaning in paths become "_", long names are cut.
std::string fileWordOf(std::string name) {
  constexpr std::size_t mostBytes = 100;
  const auto isInside = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };  // UTF-8
  if (name.size() > mostBytes) {
    std::size_t end = mostBytes;
    while (end > 0 && isInside(name[end])) --end;
    name.resize(end);
  }
  for (char& c : name)
    if (std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos ||
        static_cast<unsigned char>(c) < 32)
      c = '_';
  return name;
}

// Returns "scan-Bone.stl", with a number if `others` contains that path.
std::string pathBeside(const std::string& path, const Segment& segment,
                       const std::vector<std::string>& others) {
  const std::size_t ending = path.rfind('.');
  const auto pathOf = [&](const std::string& word) {
    return path.substr(0, ending) + "-" + word + path.substr(ending);
  };
  return pathOf(freeName(fileWordOf(segment.label), [&](const std::string& word) {
    return std::ranges::find(others, pathOf(word)) != others.end();
  }));
}

// Returns one path for each segment with voxels, or `path` alone.
std::vector<std::string> surfacePaths(const std::string& path, std::span<const Segmented> maps,
                                      bool inOneFile) {
  const bool isAlone = maps.size() == 1 && maps.front().segments.size() == 1;
  std::vector<std::string> paths;
  for (const Segmented& map : maps) {
    const auto counts = labelCounts(map.labels);
    for (const Segment& segment : map.segments) {
      if (counts[std::size_t(segment.number)] == 0) continue;
      if (inOneFile || isAlone) return {path};
      paths.push_back(pathBeside(path, segment, paths));
    }
  }
  return paths;
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

Status checkWritable(std::span<const std::string> paths) {
  for (const std::string& path : paths)
    if (auto file = OutputFile::create(path); !file) return file.error();
  return {};
}

std::vector<std::string> surfaceNotes(std::span<const std::string> files,
                                      std::span<const SurfaceToWrite> surfaces, bool inOneFile) {
  std::vector<std::string> notes;
  std::size_t file = 0;
  for (const SurfaceToWrite& each : surfaces) {
    if (each.surface.triangles.empty()) {
      notes.push_back(each.name + " has no voxels, and no surface.");
      continue;
    }
    const std::string about = inOneFile ? files[0] + ": " + each.name : files[file++];
    for (const std::string& told : toldOf(each)) notes.push_back(about + ": " + told);
  }
  return notes;
}

Status commitAll(std::vector<OutputFile>& files) {
  for (OutputFile& file : files)
    if (Status s = file.commit(); !s) return s;
  return {};
}

// Builds, writes aside and releases one surface at a time to save memory. The files appear once all are
// written.
Exported asFileEach(const Export& e, const std::vector<std::string>& paths) {
  ExportedSegments done{paths, {}};
  std::vector<OutputFile> written;
  const IdentityFields whose = identityFields(e.series);
  for (const Segmented& map : e.maps)
    for (const Segment& segment : map.segments) {
      const auto made = surfaceToWrite(map, segment, e.surfaces.reducedByMm, e.cancel);
      if (!made) return made.error();
      std::ranges::move(surfaceNotes(std::span(paths).subspan(written.size()), {&*made, 1}, false),
                        std::back_inserter(done.notes));
      if (made->surface.triangles.empty()) continue;
      const SurfacePart part{made->name, &made->surface};
      auto file = surfacesAside({&part, 1}, paths[written.size()], e.cancel, whose);
      if (!file) return file.error();
      written.push_back(std::move(*file));
    }
  if (Status s = commitAll(written); !s) return s.error();
  return done;
}

// Checks that the files can be written before it builds surfaces.
Exported asSurfaces(const Export& e) {
  const std::vector<std::string> paths = surfacePaths(e.path, e.maps, e.surfaces.inOneFile);
  if (paths.empty()) return Error{e.path + " is not written: no segment has voxels."};
  if (Status s = checkWritable(paths); !s) return s.error();
  if (!e.surfaces.inOneFile) return asFileEach(e, paths);
  const auto surfaces = surfacesToWrite(e.maps, e.surfaces.reducedByMm, e.cancel);
  if (!surfaces) return surfaces.error();
  return exportSurfaces(paths, *surfaces, e.series, e.cancel);
}

// One row for each file format.
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

Result<std::vector<std::string>> filesOfExport(const std::string& path, std::span<const Segmented> maps,
                                               const SurfaceWriting& surfaces) {
  const Result<const Row*> row = rowOf(path);
  if (!row) return row.error();
  if ((*row)->format.isSurface) return surfacePaths(path, maps, surfaces.inOneFile);
  std::vector<std::string> files{path};
  if ((*row)->write == asLabels) files.push_back(labelTableOf(path));
  return files;
}

Result<ExportedSegments> exportSegments(const std::string& path, std::span<const Segmented> maps,
                                        const Series& series, const Progress& progress,
                                        const CancelToken& cancel, const SurfaceWriting& surfaces) {
  const Result<const Row*> row = rowOf(path);
  if (!row) return row.error();
  const auto written = filesOfExport(path, maps, surfaces);
  if (!written) return written.error();
  if (Status s = checkApartFrom(series, *written); !s) return s.error();
  return (*row)->write({path, maps, series, progress, cancel, surfaces});
}

// Writes all files or none.
Result<ExportedSegments> exportSurfaces(std::span<const std::string> files,
                                        std::span<const SurfaceToWrite> surfaces, const Series& series,
                                        const CancelToken& cancel) {
  if (files.empty()) return Error{"Nothing is written: no segment has voxels."};
  if (Status s = checkApartFrom(series, files); !s) return s.error();
  if (Status s = checkWritable(files); !s) return s.error();
  std::vector<SurfacePart> parts;
  for (const SurfaceToWrite& each : surfaces)
    if (!each.surface.triangles.empty()) parts.push_back({each.name, &each.surface});
  const bool inOneFile = parts.size() > files.size();
  std::vector<OutputFile> written;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const std::span all(parts);
    auto file = surfacesAside(inOneFile ? all : all.subspan(n, 1), files[n], cancel, identityFields(series));
    if (!file) return file.error();
    written.push_back(std::move(*file));
  }
  if (Status s = commitAll(written); !s) return s.error();
  return ExportedSegments{{files.begin(), files.end()}, surfaceNotes(files, surfaces, inOneFile)};
}

}  // namespace volumen
