#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/files/image_header.h"
#include "io/files/output_file.h"
#include "viewer/segment/segment.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The table beside an image of labels: NAME.label for NAME.nii.gz or NAME.mha, a label description file as
/// ITK-SNAP writes and reads (`itksnap -s NAME.nii.gz -l NAME.label`): number, colour, opacity, whether it is
/// shown, name.
std::string labelTableOf(const std::string& image);

/// A quotation mark in a name becomes an apostrophe, a line end, a tab and the like a blank. It is there once
/// it is committed.
Result<OutputFile> writeLabelTable(std::span<const Segment> segments, const std::string& path);
/// What such a table calls the segments that it calls otherwise.
std::vector<std::string> namesChangedInTable(std::span<const Segment> segments);

/// A row of such a table, and the number that it is for.
struct LabelRow {
  std::uint32_t value = 0;
  Segment segment;
};
/// Its rows but that of the background. The Error names the file and the line; read in a worker where there
/// are any.
Result<std::vector<LabelRow>> readLabelTable(const std::string& path);

}  // namespace volumen
