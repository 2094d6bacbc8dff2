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

/// What became of segments that were written.
struct ExportedSegments {
  std::vector<std::string> files;
  std::vector<std::string> notes;  ///< sentences that are to be known
};

/// A kind of file that segments can be written as.
struct SegmentFormat {
  const char* ending;  ///< of its names: ".seg.nrrd"
  const char* noun;    ///< "Segmentations of 3D Slicer"
  /// Whether it holds surfaces.
  bool isSurface = false;
};

/// How surfaces are written.
struct SurfaceWriting {
  double reducedByMm = 0;  ///< with fewer triangles, none farther off than this (reduced()); 0: with all
  bool inOneFile = false;  ///< those of all segments; else a file a segment
};

/// All of them, the usual one first.
std::span<const SegmentFormat> segmentFormats();
/// That of a path by its ending, capitals or not; the Error names all endings.
Result<const SegmentFormat*> segmentFormatOf(const std::string& path);

/// The files that exportSegments() writes, the table beside an image of labels among them; of surfaces those
/// of segments that have voxels. Names of segments of more than 100 bytes are cut in them, and files of two
/// differ by a number: "scan-Bone (2).stl". The Error: no such ending.
Result<std::vector<std::string>> filesOfExport(const std::string& path, std::span<const Segmented> maps,
                                               const SurfaceWriting& surfaces = {});

/// Writes the segments of a series as the ending of `path` says, hidden ones too; several maps, all of one
/// grid, where they overlap, which .seg.nrrd, .dcm and surfaces hold. Surfaces
/// (occupancy.h) are a file each: `path` for one segment, else with its name in front of the ending; or all
/// are in `path`. Their notes tell volumes, area and triangles, and of reduced ones how far they are off.
/// Surfaces are made, written and let go one after the other where each has a file. Each file appears whole
/// or not at all, those of surfaces once all are written, and none over a file of the series. The Error names
/// it.
Result<ExportedSegments> exportSegments(const std::string& path, std::span<const Segmented> maps,
                                        const Series& series, const Progress& progress = {},
                                        const CancelToken& cancel = {}, const SurfaceWriting& surfaces = {});

/// The same of surfaces that were made (surfacesToWrite()): `files` are those that filesOfExport() says, one
/// for all, or one for each that has triangles.
Result<ExportedSegments> exportSurfaces(std::span<const std::string> files,
                                        std::span<const SurfaceToWrite> surfaces, const Series& series,
                                        const CancelToken& cancel = {});

}  // namespace volumen
