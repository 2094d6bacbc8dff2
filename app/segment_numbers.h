#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/open_volume.h"
#include "io/export/segments_file.h"
#include "io/files/output_file.h"
#include "io/study/suv.h"
#include "results/numbers/segments_over_time.h"

namespace volumen {

/// The numbers of segments; with values over time if their series has several time points.
struct SegmentNumbersTold {
  std::vector<SegmentReport> reports;
  ValueScale scale;
  std::optional<SegmentsOverTime> overTime{};
  QStringList ofSeries{};  ///< seriesFields()
};

/// Reads the segments of a file onto the grid of `opened` (readSegments) and adds its notes there: one map,
/// or several if segments overlap. The Error names the file.
Result<SegmentsFile> segmentsOfFile(const std::string& file, Opened& opened, const CancelToken& cancel);

/// The requested numbers.
struct NumbersWanted {
  bool surfaces = true;  ///< false: only numbers of voxels (voxelReports())
  bool overTime = false;
};

/// Measures maps on the grid of `opened`; PET values are in `unit` if available. The Error: cancelled, or too
/// little memory.
Result<SegmentNumbersTold> numbersTold(std::span<const Segmented> maps, const Opened& opened, PetUnit unit,
                                       NumbersWanted wanted, const CancelToken& cancel);

/// Adds the numbers to a command's JSON: `segments`, each with the unit of its values, `unit`, `noSuv` for a
/// PET without SUV, and `timeAxis` for values over time.
void addSegments(nlohmann::ordered_json& all, const SegmentNumbersTold& numbers);

/// Adds a note for each empty segment, and one if lengths are unknown.
void addSegmentNotes(Opened& opened, std::span<const SegmentReport> reports);

/// Writes the numbers as CSV; the file appears once it is committed. Empty if `path` is.
Result<std::optional<OutputFile>> writeCsv(const std::string& path, const SegmentNumbersTold& numbers);

}  // namespace volumen
