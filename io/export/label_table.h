#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/files/image_header.h"
#include "io/files/output_file.h"
#include "viewer/segment/segment.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns the path of the table beside a label image: NAME.label for NAME.nii.gz or NAME.mha. It is a label
/// description file of ITK-SNAP (`itksnap -s NAME.nii.gz -l NAME.label`) with number, colour, opacity,
/// visibility and name.
std::string labelTableOf(const std::string& image);

/// Writes a label table; it appears once the file is committed. In names, quotation marks become apostrophes;
/// line ends, tabs and other control characters become blanks.
Result<OutputFile> writeLabelTable(std::span<const Segment> segments, const std::string& path);
/// Returns the names in the table of those segments whose names it changes.
std::vector<std::string> namesChangedInTable(std::span<const Segment> segments);

/// A row of a label table and the label it names.
struct LabelRow {
  std::uint32_t value = 0;
  Segment segment;
};
/// Returns all rows except the background's. The Error names the file and the line. The table is read in a
/// worker if there are any.
Result<std::vector<LabelRow>> readLabelTable(const std::string& path);

}  // namespace volumen
