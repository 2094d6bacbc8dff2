#pragma once

#include <QStringList>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "viewer/recipe/recipe.h"
#include "viewer/segment/numbers.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The numbers of one segment. Values are those of the volume; segmentNumbers() converts them to another
/// unit.
struct SegmentReport {
  Segment segment;
  std::int64_t voxels = 0;            ///< in its mask, padding included
  std::optional<double> millilitres;  ///< volume of the voxels; empty: not calibrated
  SegmentValues values;
  std::optional<SegmentForm> form;  ///< empty: no voxels, or the series is not calibrated
  std::optional<double> peak;       ///< largest mean of a 1 ml ball about one of its voxels
  int map = 0;                      ///< index among the maps of its series, from 0
  std::string made{};               ///< how, in words (madeText()); empty: unknown
};

/// Progress: the segment being measured, and the number of segments done.
using SegmentProgress = std::function<void(const Segment& segment, std::size_t done)>;

/// Returns reports of all segments as those of the volume's first map. The volume has the grid of the labels.
/// Peaks are for nuclear medicine. Returns an Error if cancelled or out of memory.
Result<std::vector<SegmentReport>> segmentReports(std::span<const Segment> segments, const LabelMap& labels,
                                                  const Volume& volume, bool withPeaks,
                                                  const CancelToken& cancel = {},
                                                  const SegmentProgress& progress = {});
/// Returns the same without peaks and without surface measures (SegmentForm::ofVoxelsAlone), in a small part
/// of the time and memory.
Result<std::vector<SegmentReport>> voxelReports(std::span<const Segment> segments, const LabelMap& labels,
                                                const Volume& volume, const CancelToken& cancel = {});
/// Adds surface measures and peaks to reports of the labels.
Status addSurfaces(std::span<SegmentReport> reports, const LabelMap& labels, const Volume& volume,
                   bool withPeaks, const CancelToken& cancel = {}, const SegmentProgress& progress = {});
/// Returns how a segment was made: by its steps ("range high 3071 low 152; grow mm 2"), else by its own
/// description.
std::string madeText(const Segment& segment, std::span<const Step> steps = {});
/// Returns whether reports of this modality have peaks (PT, NM).
bool hasPeaks(const std::string& modality);

/// Returns one object per segment (resources/docs/segment.md): its map, what it is, a member for each of
/// segmentColumns(), and the histogram. Missing members are null. Values are multiplied by `factor`.
nlohmann::ordered_json segmentsJson(std::span<const SegmentReport> all, double factor);
/// Returns fields of seriesFields() as one object, by the names of their columns.
nlohmann::ordered_json identityJson(const QStringList& fields);
/// Returns the result of likeness() as JSON.
nlohmann::ordered_json likenessJson(const SegmentLikeness& alike);

}  // namespace volumen
