#include <functional>
#include <nlohmann/json.hpp>

#include "app/exports/export_fused.h"
#include "app/exports/exports.h"
#include "app/exports/plane_stack.h"
#include "app/exports/taken_parts.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/session_view.h"
#include "io/export/dicom_folder.h"
#include "io/export/dicom_series.h"
#include "io/export/grid_series.h"
#include "io/export/study_object.h"
#include "io/files/session_file.h"
#include "viewer/segment/face.h"

namespace volumen {

namespace {

std::string outsideNote(float outside, const Opened& opened) {
  const bool isPadding = opened.loaded.drawn->attributes().padding.has_value();
  return std::string("Pixels outside of the volume have ") +
         (isPadding ? "the padding value" : "the lowest value") + ", " + nlohmann::json(outside).dump() + ".";
}

using TagsOf = std::function<DicomSeriesTags(DicomSeriesTags ofSource)>;

// Writes what was made of a series.
Result<Exported> writeMade(const ExportJob& job, SeriesSource& source, const StackVolume& made,
                           const TagsOf& tagsOf, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  Opened& opened = source.opened;
  auto read = readDicomTags(opened.series, opened.loaded, progress, cancel);
  if (!read) return read.error();
  DicomSeriesTags tags = tagsOf(*std::move(read));
  if (source.without) tags = tagsWithout(*source.without, std::move(tags), source.seriesNumber);
  const auto notes = writeDicomSeries(*made.volume, tags, job.output, progress, cancel);
  endTerminalProgress();
  if (!notes) return notes.error();
  Exported exported{std::move(opened.notes), opened.loaded.unread, {}};
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  if (made.outside) exported.notes.push_back(outsideNote(*made.outside, opened));
  return exported;
}

Result<Exported> writeStack(const ExportJob& job, const SliceStack& stack, SeriesSource source,
                            const CancelToken& cancel) {
  const auto made = resampleStack(*source.opened.loaded.drawn, stack, terminalProgress(), cancel);
  if (!made) return made.error();
  const auto tagsOf = [&](DicomSeriesTags tags) {
    return stackTags(std::move(tags), source.opened.loaded, stack, source.seriesNumber);
  };
  return writeMade(job, source, *made, tagsOf, cancel);
}

// Writes slices on their own grid, after parts were taken away.
Result<Exported> writeOwnGrid(const ExportJob& job, SeriesSource source, const CancelToken& cancel) {
  noteKeptTilt(source.opened);
  const auto tagsOf = [](DicomSeriesTags tags) { return tags; };
  return writeMade(job, source, StackVolume{source.opened.loaded.drawn, {}}, tagsOf, cancel);
}

Result<Exported> writeDefaced(const ExportJob& job, SeriesSource source, const CancelToken& cancel) {
  noteKeptTilt(source.opened);
  const auto without = defaced(*source.opened.loaded.drawn, cancel);
  if (!without) return without.error();
  const auto tagsOf = [&](DicomSeriesTags tags) { return defacedTags(std::move(tags), source.seriesNumber); };
  auto exported = writeMade(job, source, StackVolume{*without, {}}, tagsOf, cancel);
  if (exported)
    exported->notes.emplace_back(
        "The face was taken away, and the air in front of it. Look at a rendering before you hand it on.");
  return exported;
}

// Returns the grid of --onto, with notes in `opened`.
Result<OtherGrid> otherGrid(const ExportJob& job, Opened& opened, const CancelToken& cancel) {
  const auto other = openVolume(job.onto.empty() ? job.path : job.onto, job.ontoSeries, cancel);
  if (!other) return other.error();
  if (Status s = checkLosses(other->series.path, other->loaded.unread); !s) return s.error();
  addUnread(opened.loaded.unread, other->loaded.unread);
  const auto relation = relationOfSpaces(*other, opened, job.relation, cancel);
  if (!relation) return relation.error();
  for (const auto* notes : {&other->notes, &relation->notes})
    opened.notes.insert(opened.notes.end(), notes->begin(), notes->end());
  const PlacedGrid placed{other->loaded.drawn->geometry(), relation->toFromFrom, interpolationOf(job.plane)};
  return OtherGrid{placed, other->series, relation->words};
}

Result<Exported> writeOnto(const ExportJob& job, SeriesSource source, const CancelToken& cancel) {
  const auto grid = otherGrid(job, source.opened, cancel);
  if (!grid) return grid.error();
  const auto made = resampleOnGrid(*source.opened.loaded.drawn, *grid, terminalProgress(), cancel);
  if (!made) return made.error();
  const auto tagsOf = [&](DicomSeriesTags tags) {
    return gridTags(std::move(tags), source.opened.loaded, *grid, source.seriesNumber);
  };
  return writeMade(job, source, *made, tagsOf, cancel);
}

Result<Exported> exportStack(const ExportJob& job, const AskedPlane& asked, SeriesSource source,
                             const CancelToken& cancel) {
  noteEvenSlices(job.plane, source.opened);
  const VoxelGeometry& geometry = source.opened.loaded.drawn->geometry();
  const auto stack = job.shapes.empty() ? planeStack(job, asked, geometry) : curveStack(job, asked, geometry);
  if (!stack) return stack.error();
  return job.overlay.isGiven() ? exportFused(job, *stack, std::move(source), cancel)
                               : writeStack(job, *stack, std::move(source), cancel);
}

bool hasStack(const ExportJob& job) {
  return job.hasPlane || job.spacingMm || !job.plane.size.empty() || !job.shapes.empty() ||
         job.overlay.isGiven();
}

// Refuses --deface for a series from which parts are taken away.
Status checkAlone(const ExportJob& job) {
  if (!job.deface) return {};
  return Error{
      "--deface does not go with parts that are taken away otherwise: write one series, then the other of "
      "what was written."};
}

// Opens the series of a job or of its session, and takes parts of it away.
Result<SeriesSource> openSource(const ExportJob& job, const CancelToken& cancel) {
  std::optional<SessionView> session;
  if (isSessionFile(job.path)) {
    auto read = readSessionView(job.path, cancel);
    if (!read) return read.error();
    session = *std::move(read);
  }
  const std::string& path = session ? session->series.path : job.path;
  const Result<Study> study = openStudyAt(path, cancel);
  if (!study) return study.error();
  const MemoryUse use = job.takesAway() ? segmenting : MemoryUse{};
  auto opened =
      session ? openSeries(session->series, cancel) : openVolume(*study, path, job.series, cancel, use);
  if (!opened) return opened.error();
  if (Status s = checkLosses(path, opened->loaded.unread); !s) return s.error();
  const int seriesNumber = nextSeriesNumber(*study, opened->series.studyUid);
  auto without = takePartsAway(job, session, *opened, cancel);
  if (!without) return without.error();
  return SeriesSource{*std::move(opened), seriesNumber, *std::move(without)};
}

}  // namespace

Status checkSeries(const ExportJob& job) {
  if (!job.window.empty() && !job.overlay.isGiven())
    return Error{"--window does not go with --as series without --overlay: its values are kept."};
  if (job.deface && (hasStack(job) || job.isOnto()))
    return Error{
        "--deface writes the slices as they are: leave --roi, --onto, --overlay, --spacing, --size and the "
        "options "
        "of the plane out."};
  if (isSessionFile(job.path) && (!job.series.empty() || job.takesAway()))
    return Error{
        job.path +
        " is a session, which says what is shown: leave --series, --remove-table and --segments out."};
  if (job.takesAway())
    if (Status s = checkAlone(job); !s) return s;
  if (const auto asked = readPlane(job.plane); !asked) return asked.error();
  return checkWindows(job);
}

Result<Exported> exportSeries(const ExportJob& job, const CancelToken& cancel) {
  const auto asked = readPlane(job.plane);
  if (!asked) return asked.error();
  if (Status s = checkDicomFolder(job.output); !s) return s.error();
  auto source = openSource(job, cancel);
  if (!source) return source.error();
  const bool isCut = source->without.has_value();
  if (isCut)
    if (Status s = checkAlone(job); !s) return s.error();
  if (job.deface) return writeDefaced(job, *std::move(source), cancel);
  if (job.isOnto()) return writeOnto(job, *std::move(source), cancel);
  if (isCut && !hasStack(job)) return writeOwnGrid(job, *std::move(source), cancel);
  return exportStack(job, *asked, *std::move(source), cancel);
}

}  // namespace volumen
