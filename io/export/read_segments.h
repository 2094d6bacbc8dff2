#pragma once

#include <string>

#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// Reads the segments of a file onto a grid of a series (onGrid). By its contents, the file is a DICOM
/// segmentation, an RT Structure Set (contour_segments.h), a segmentation of 3D Slicer or a label image.
/// All segments get a colour and a unique name; changed names are in the notes. With the acquired `slices`
/// that the grid was resampled from, a DICOM segmentation also keeps its pixels on those.
/// The Error names the file: it is of none of these kinds, damaged, without segments, or entirely outside the
/// grid. Also an Error: its frame of reference differs from the series and it names none of its images.
Result<SegmentsFile> readSegments(const std::string& path, const Series& series, const VoxelGeometry& grid,
                                  const Progress& progress = {}, const CancelToken& cancel = {},
                                  const AcquiredSlices& slices = {});

/// Reads segments onto the grid of the file itself, wherever it lies; for a DICOM segmentation that is
/// gridOf() it. Structure sets have none: an Error.
Result<SegmentsFile> readSegments(const std::string& path, const Progress& progress = {},
                                  const CancelToken& cancel = {});

/// True if two files (on their own grids) are in one space: their frames of reference do not differ, or they
/// name the same images.
bool areOfOneSpace(const SegmentsFile& a, const SegmentsFile& b);

/// True if the name says that a file holds segments rather than an image: .seg.nrrd, or an image with a table
/// of names beside it (label_table.h).
bool isNamedAsSegments(const std::string& path);

}  // namespace volumen
