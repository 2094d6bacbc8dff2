#pragma once

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

/// What is told of one segment. Values are those of the volume; segmentNumbers() gives them in another unit.
struct SegmentReport {
  Segment segment;
  std::int64_t voxels = 0;            ///< of its mask, padding included
  std::optional<double> millilitres;  ///< of them; none: not calibrated
  SegmentValues values;
  std::optional<SegmentForm> form;  ///< none: no voxels, or the series is not calibrated
  std::optional<double> peak;       ///< the largest mean of a ball of 1 ml about one of its voxels
  int map = 0;                      ///< which of the maps of its series, from 0
  std::string made{};               ///< how, in words (madeText()); empty: not known
};

/// How far it is: which segment is measured, and how many were.
using SegmentProgress = std::function<void(const Segment& segment, std::size_t done)>;

/// Of all segments of a volume, whose grid is that of the labels, as those of its first map; peaks where they
/// are asked for: of nuclear medicine. The Error: cancelled, or there is not enough memory.
Result<std::vector<SegmentReport>> segmentReports(std::span<const Segment> segments, const LabelMap& labels,
                                                  const Volume& volume, bool withPeaks,
                                                  const CancelToken& cancel = {},
                                                  const SegmentProgress& progress = {});
/// The same without peaks and without what takes the surfaces (SegmentForm::ofVoxelsAlone): a small part of
/// the time and of the memory.
Result<std::vector<SegmentReport>> voxelReports(std::span<const Segment> segments, const LabelMap& labels,
                                                const Volume& volume, const CancelToken& cancel = {});
/// Adds those to reports of the labels.
Status addSurfaces(std::span<SegmentReport> reports, const LabelMap& labels, const Volume& volume,
                   bool withPeaks, const CancelToken& cancel = {}, const SegmentProgress& progress = {});
/// How a segment was made, by its steps ("range high 3071 low 152; grow mm 2"), else by what is said of it.
std::string madeText(const Segment& segment, std::span<const Step> steps = {});
/// Whether peaks are told of series of this modality (PT, NM).
bool hasPeaks(const std::string& modality);

/// One object a segment (resources/docs/segment.md): its map, what it is, a member for each of
/// segmentColumns(), and the histogram; what there is none of is null. Values times `factor`.
nlohmann::ordered_json segmentsJson(std::span<const SegmentReport> all, double factor);
/// What likeness() says.
nlohmann::ordered_json likenessJson(const SegmentLikeness& alike);

}  // namespace volumen
