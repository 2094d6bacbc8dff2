#pragma once

#include <string>

#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// Reads the segments of a file on a grid of a series (onGrid): a DICOM segmentation, a segmentation of 3D
/// Slicer, or an image of labels, as its contents say. All have a colour, and a name that no other one has;
/// names that were given are told. The Error names the file: it is none of them, is
/// damaged, holds no segments, is of another frame of reference than the series and names none of its
/// pictures, or all of it lies outside.
/// With `slices`, of which the grid is drawn, a DICOM segmentation whose frames lie on these is known there,
/// too.
Result<SegmentsFile> readSegments(const std::string& path, const Series& series, const VoxelGeometry& grid,
                                  const Progress& progress = {}, const CancelToken& cancel = {},
                                  const AcquiredSlices& slices = {});

/// The same on the grid of the file's own, wherever that lies; of a DICOM segmentation gridOf() it.
Result<SegmentsFile> readSegments(const std::string& path, const Progress& progress = {},
                                  const CancelToken& cancel = {});

/// Whether the places of two files (on grids of their own) are those of one space: their frames of reference
/// do not differ, or they name the same pictures.
bool areOfOneSpace(const SegmentsFile& a, const SegmentsFile& b);

/// Whether a file says by its name that it holds segments, no picture: .seg.nrrd, or an image with a table of
/// names beside it (label_table.h).
bool isNamedAsSegments(const std::string& path);

}  // namespace volumen
