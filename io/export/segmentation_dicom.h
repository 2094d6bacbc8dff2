#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// Attributes of a written segmentation. Text is UTF-8.
struct SegmentationTags {
  std::string description = "Segmentation";  ///< SeriesDescription: shown in study lists
  std::string creator{};                     ///< name of the author in DICOM format
  std::string date{}, time{};                ///< creation date and time in DICOM format; if empty, now
};

/// A segment and its voxels; masks may overlap.
struct SegmentVoxels {
  Segment segment;
  BitMask mask;
};

/// Writes segments on a grid of a DICOM series as a segmentation object (SEG, BINARY; PS3.3 A.51) into
/// `path`, as a new series in the study of its images. The file is Explicit VR Little Endian and appears
/// whole or not at all.
/// Its frames lie pixel by pixel on the acquired slices of the series and reference them. A pixel is set if
/// the voxel that contains its centre is set. All maps (or masks) must have one grid. Segments are
/// renumbered from 1 and keep names, codes and colours. UIDs are derived from contents and tags.
/// Returns notes for the user: voxels outside the images, segments without a code (written as "Tissue"),
/// names shortened to 64 characters. Returns an Error if the file cannot be written, no slice has a marked
/// pixel, or the export was cancelled. Also returns an Error if the series is not from DICOM files, or if
/// its files have changed or lack positions or UIDs of their own (checkNames()).
Result<std::vector<std::string>> writeSegmentationDicom(std::span<const Segmented> maps, const Series& series,
                                                        const SegmentationTags& tags, const std::string& path,
                                                        const Progress& progress = {},
                                                        const CancelToken& cancel = {});
Result<std::vector<std::string>> writeSegmentationDicom(std::span<const SegmentVoxels> segments,
                                                        const Series& series, const SegmentationTags& tags,
                                                        const std::string& path,
                                                        const Progress& progress = {},
                                                        const CancelToken& cancel = {});

}  // namespace volumen
