#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/export/surfaces_to_write.h"
#include "io/study/progress.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// The result of writing segments.
struct ExportedSegments {
  std::vector<std::string> files;
  std::vector<std::string> notes;  ///< notes for the user
};

/// A file format for segments.
struct SegmentFormat {
  const char* ending;  ///< file name ending: ".seg.nrrd"
  const char* noun;    ///< "Segmentations of 3D Slicer"
  /// True if it holds surfaces.
  bool isSurface = false;
};

/// Options for writing surfaces.
struct SurfaceWriting {
  double reducedByMm = 0;  ///< largest deviation of reduced surfaces in mm (reduced()); 0: all triangles
  bool inOneFile = false;  ///< true: all segments in one file; false: one file a segment
};

/// Returns all formats, the default one first.
std::span<const SegmentFormat> segmentFormats();
/// Returns the format for a path's ending, ignoring case; the Error names all endings.
Result<const SegmentFormat*> segmentFormatOf(const std::string& path);

/// Returns the files that exportSegments() writes, including the table beside a label image. Surfaces are
/// written for segments with voxels only. Segment names are cut to 100 bytes in file names, and equal names
/// get a number: "scan-Bone (2).stl". The Error: the ending is unknown.
Result<std::vector<std::string>> filesOfExport(const std::string& path, std::span<const Segmented> maps,
                                               const SurfaceWriting& surfaces = {});

/// Writes the segments of a series, also hidden ones, in the format of the ending of `path`. Overlapping
/// segments need several maps of one grid, which only .seg.nrrd, .dcm and surfaces hold.
/// Surfaces (occupancy.h) have one file each: `path` for one segment, else with its name before the ending;
/// or all are in `path`. Their notes state volumes, area and triangles, and the deviation of reduced
/// surfaces. Surfaces with a file each are built, written and released one at a time.
/// Each file appears whole or not at all; surfaces appear once all are written. Files of the series are never
/// overwritten. The Error names the file.
Result<ExportedSegments> exportSegments(const std::string& path, std::span<const Segmented> maps,
                                        const Series& series, const Progress& progress = {},
                                        const CancelToken& cancel = {}, const SurfaceWriting& surfaces = {});

/// Writes surfaces that were built by surfacesToWrite(). `files` come from filesOfExport(): one for all, or
/// one for each surface with triangles.
Result<ExportedSegments> exportSurfaces(std::span<const std::string> files,
                                        std::span<const SurfaceToWrite> surfaces, const Series& series,
                                        const CancelToken& cancel = {});

}  // namespace volumen
