#include "app/exports/taken_parts.h"

#include <algorithm>

#include "app/segment_numbers.h"
#include "io/export/dicom_elements.h"
#include "results/text/series_text.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

// All segments of a file together.
struct AllSegments {
  BitMask voxels;
  std::string names;  // the first of them
};

AllSegments allOf(const SegmentsFile& file, const VoxelGeometry& geometry) {
  constexpr int most = 5;
  AllSegments all{BitMask(geometry), {}};
  int count = 0;
  for (const Segmented& map : file.maps)
    for (const Segment& segment : map.segments) {
      all.voxels = united(std::move(all.voxels), maskOf(map.labels, std::uint8_t(segment.number)));
      if (++count <= most) all.names += (count > 1 ? ", " : "") + inOneLine(segment.label);
    }
  if (count > most) all.names += " and " + std::to_string(count - most) + " more";
  return all;
}

Result<TakenAway> takeTable(Opened& opened, const CancelToken& cancel) {
  if (Status s = takeAway(Mask{true, {}}, opened, cancel); !s) return s.error();
  return TakenAway{"Without table", "the table and everything else outside of the patient"};
}

Result<TakenAway> takeBySegments(const ExportJob& job, Opened& opened, const CancelToken& cancel) {
  const auto file = segmentsOfFile(job.segments, opened, cancel);
  if (!file) return file.error();
  AllSegments all = allOf(*file, opened.loaded.drawn->geometry());
  if (all.voxels.empty())
    return Error{job.segments + ": no voxel of the series lies in its segments; name another file."};
  if (job.withoutSegments) all.voxels = inverted(std::move(all.voxels));
  const auto left = keptAlone(*opened.loaded.drawn, all.voxels, cancel);
  if (!left) return left.error();
  opened.loaded.drawn = *left;
  return job.withoutSegments
             ? TakenAway{(job.removeTable ? "without " : "Without ") + all.names, "the segments " + all.names}
             : TakenAway{all.names + " alone", "everything outside of the segments " + all.names};
}

Result<TakenAway> takeAsked(const ExportJob& job, Opened& opened, const CancelToken& cancel) {
  TakenAway all;
  if (job.removeTable) {
    const auto table = takeTable(opened, cancel);
    if (!table) return table.error();
    all = *table;
  }
  if (job.segments.empty()) return all;
  const auto rest = takeBySegments(job, opened, cancel);
  if (!rest) return rest.error();
  all.title += (all.title.empty() ? "" : ", ") + rest->title;
  all.parts += (all.parts.empty() ? "" : ", and of ") + rest->parts;
  return all;
}

// True for segments that tissue depends on, whose file was not read.
bool isLost(const SegmentMap& map) {
  return !map.labels && map.tissue.where != TissueShown::Where::everywhere;
}

Result<TakenAway> takeLeftOut(const SessionView& session, Opened& opened, const CancelToken& cancel) {
  if (std::ranges::any_of(session.segments, isLost))
    return Error{
        "The segments of the session were not found, inside or outside of which it shows the series in 3D: "
        "open it in the window and show the series everywhere."};
  std::string what;
  if (!session.mask.empty()) {
    if (Status s = takeAway(session.mask, opened, cancel); !s) return s.error();
    what = cutText(opened.loaded.drawn->attributes().cut);
  }
  if (showsTissueApart(session, *opened.loaded.drawn)) {
    const auto left = tissueAlone(session, *opened.loaded.drawn, cancel);
    if (!left) return left.error();
    opened.loaded.drawn = *left;
    what += (what.empty() ? "" : ", ") + tissueText(session.segments.front().tissue).toStdString();
  }
  if (what.empty()) return TakenAway{};
  return TakenAway{"As shown in 3D", "what a session leaves out in 3D (" + what + ")"};
}

}  // namespace

Result<std::optional<TakenAway>> takePartsAway(const ExportJob& job,
                                               const std::optional<SessionView>& session, Opened& opened,
                                               const CancelToken& cancel) {
  auto taken = session ? takeLeftOut(*session, opened, cancel) : takeAsked(job, opened, cancel);
  if (!taken) return taken.error();
  if (taken->parts.empty()) return std::optional<TakenAway>();
  opened.notes.push_back("Air is in place of " + taken->parts + ".");
  return std::optional(*std::move(taken));
}

}  // namespace volumen
