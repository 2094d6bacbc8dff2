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

/// What a written segmentation says of itself. Text is UTF-8.
struct SegmentationTags {
  std::string description = "Segmentation";  ///< SeriesDescription: what it is listed by
  std::string creator{};                     ///< who made it, as DICOM writes names
  std::string date{}, time{};                ///< of its making, as DICOM writes them; empty: now
};

/// A segment and its voxels; several of them may overlap.
struct SegmentVoxels {
  Segment segment;
  BitMask mask;
};

/// Writes segments on a grid of a DICOM series as a segmentation object (SEG, BINARY; PS3.3 A.51): `path`,
/// Explicit VR Little Endian, appears whole or not at all. Its frames lie on the slices of the series as
/// acquired, pixel by pixel, and name them; a pixel is set where the voxel that holds its centre is. All maps
/// (all masks) are of one grid. It becomes a series of its own in the study of its pictures; segments are
/// numbered anew from 1, and keep names, codes, colours. UIDs follow from contents and tags.
/// Gives sentences that are to be known: what was marked where no picture is, segments without a code, which
/// are written as "Tissue", names that were shortened to 64 characters. The Error: the series comes from no
/// DICOM files, or they are not what they were, or do not say where they lie; nothing is marked on its
/// slices; it cannot be written; cancelled.
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
