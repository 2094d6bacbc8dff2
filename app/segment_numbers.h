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
#include "ui/workspace/segments_over_time.h"

namespace volumen {

/// What there is to say of segments; values over time where their series has several time points.
struct SegmentNumbersTold {
  std::vector<SegmentReport> reports;
  ValueScale scale;
  std::optional<SegmentsOverTime> overTime{};
  QStringList ofSeries{};  ///< seriesFields()
};

/// The segments of a file on the grid of what was opened (readSegments), whose notes get what that changes:
/// one map; where segments overlap, several. The Error names the file.
Result<SegmentsFile> segmentsOfFile(const std::string& file, Opened& opened, const CancelToken& cancel);

/// Which numbers are asked for.
struct NumbersWanted {
  bool surfaces = true;  ///< else those of voxels alone (voxelReports())
  bool overTime = false;
};

/// The numbers of maps on the grid of what was opened, values of PET in `unit` where that can be had. The
/// Error: cancelled, or there is not enough memory.
Result<SegmentNumbersTold> numbersTold(std::span<const Segmented> maps, const Opened& opened, PetUnit unit,
                                       NumbersWanted wanted, const CancelToken& cancel);

/// Adds them to the JSON of a command: `segments`, each with the unit of its values, `unit`, `noSuv` where a
/// PET has no SUV, and `timeAxis` where there are values over time.
void addSegments(nlohmann::ordered_json& all, const SegmentNumbersTold& numbers);

/// Adds a sentence for each segment that is empty, and where there are no lengths.
void addSegmentNotes(Opened& opened, std::span<const SegmentReport> reports);

/// The numbers as CSV, a file that is there once it is committed; none where `path` is empty.
Result<std::optional<OutputFile>> writeCsv(const std::string& path, const SegmentNumbersTold& numbers);

}  // namespace volumen
