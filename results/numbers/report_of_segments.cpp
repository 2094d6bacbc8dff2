#include "results/numbers/report_of_segments.h"

#include "results/numbers/report_codes.h"

namespace volumen {

namespace {

bool isSaid(const Code& code) { return !code.value.empty() && !code.scheme.empty(); }

}  // namespace

Result<MeasurementGroup> reportedSegment(const SegmentReport& report, const std::string& segmentationUid,
                                         const std::vector<ReferencedPicture>& sources,
                                         const ValueScale& scale) {
  const Segment& segment = report.segment;
  if (report.voxels == 0) return Error{"it has no voxels"};
  if (!report.millilitres) return Error{"its volume is not known in ml, as its images are not calibrated"};
  MeasurementGroup group;
  group.trackingId = segment.trackingId.empty() ? segment.label : segment.trackingId;
  group.trackingUid = segment.trackingUid;
  group.category = segment.category;
  group.finding = isSaid(segment.type) ? segment.type : Code{"label", "99VOLUMEN", segment.label};
  group.site = segment.region;
  group.pictures = {{segmentationUid, {}, {}, {segment.number}}};
  group.pictures.insert(group.pictures.end(), sources.begin(), sources.end());
  group.measurements = {{volumeCode, millilitre, *report.millilitres, {}, {}}};
  const SegmentValues& v = report.values;
  const double f = scale.factor;
  if (v.voxels == 0) return group;
  for (const ReportMeasurement& one :
       reportedValues(f * v.mean, f * v.sd, f * v.min, f * v.max, unitOfValues(scale.unit)))
    group.measurements.push_back(one);
  return group;
}

}  // namespace volumen
