#include "ui/exports/file_offers.h"

#include <QDir>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "io/deidentify/faceless_series.h"
#include "io/export/export_segments.h"
#include "io/export/key_objects_dicom.h"
#include "io/export/presentation_state.h"
#include "io/export/report_dicom.h"
#include "io/export/rtstruct.h"
#include "io/export/slice_stack.h"
#include "io/load.h"
#include "io/study/frame_series.h"
#include "results/numbers/shapes_presentation.h"
#include "results/numbers/shapes_report.h"
#include "results/text/text.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/document/open_studies.h"
#include "ui/workspace/session.h"

namespace volumen {

namespace {

QStringList texts(const std::vector<std::string>& sentences) {
  QStringList all;
  for (const std::string& one : sentences) all << QString::fromStdString(one);
  return all;
}

// Returns the files of an open series, or of all that is open of its study.
std::vector<std::string> openFilesOf(const OpenStudies& open, const Series& shown, bool isOfStudy) {
  std::set<std::string> files(shown.files.begin(), shown.files.end());
  const auto belongs = [&](const SeriesIdentity& each) {
    const bool isSameSeries = !shown.seriesUid.empty() && each.seriesUid == shown.seriesUid;
    return !shown.studyUid.empty() && each.studyUid == shown.studyUid && each.patientId == shown.patientId &&
           (isOfStudy || isSameSeries);
  };
  for (const Series* series : open.pictures()) {
    if (series->format != "DICOM" || !belongs(*series)) continue;
    files.insert(series->files.begin(), series->files.end());
    for (const Unread& unread : series->unread)
      if (!unread.beside) files.insert(unread.path);
  }
  for (const DerivedObjectPtr& object : open.derived())
    if (isOfStudy && belongs(*object)) files.insert(object->path);
  return {files.begin(), files.end()};
}

FileOffer offerOfFiles(const QString& text, const QString& name, std::vector<std::string> files) {
  return {text, name,
          [files = std::move(files)](const QString&, const Job&) { return Result(LeavingFiles{files}); }};
}

std::string pathIn(const QString& folder, const QString& name) {
  return (folder + QLatin1Char('/') + name + QStringLiteral(".dcm")).toStdString();
}

FileOffer offerOfSegmentation(const std::vector<SegmentMap>& maps, const Series& series) {
  const QString name = QStringLiteral("segments");
  return {tr("Its segments as they are now"), name,
          [maps, series, name](const QString& folder, const Job& job) -> Result<LeavingFiles> {
            const auto segments = segmentedOnSlices(maps, series, job.cancel());
            if (!segments) return segments.error();
            const auto made =
                exportSegments(pathIn(folder, name), *segments, series, job.progress(), job.cancel());
            if (!made) return made.error();
            return LeavingFiles{made->files, texts(made->notes)};
          }};
}

FileOffer offerOfStructureSet(const std::vector<SegmentMap>& maps, const Series& series, const Study& study) {
  const QString name = QStringLiteral("structures");
  StructureSetTags tags;
  tags.description = "Segments";
  tags.seriesNumber = nextSeriesNumber(study, series.studyUid);
  return {tr("Its segments as an RT structure set"), name,
          [maps, series, tags, name](const QString& folder, const Job& job) -> Result<LeavingFiles> {
            const std::string path = pathIn(folder, name);
            const auto notes =
                writeStructureSet(segmentedOf(maps), series, tags, path, job.progress(), job.cancel());
            if (!notes) return notes.error();
            return LeavingFiles{{path}, texts(*notes)};
          }};
}

// The measurements of a study, as they are when an export is requested.
struct MeasuredStudy {
  Study study;
  std::vector<ShapeToMeasure> shapes;
  std::vector<SeriesKey> of;                    // the series of each shape
  std::map<SeriesKey, Series> series;           // those that shapes in space are measured in
  std::map<SeriesKey, LoadedSeriesPtr> held{};  // those of them that are in memory

  // Returns the volume of a series, which is read unless it is in memory.
  Result<ShapesVolume> volumeOf(const SeriesKey& key, const Job& job) const {
    if (const auto found = held.find(key); found != held.end())
      return ShapesVolume{found->second->series, found->second->volume, found->second->origins,
                          found->second->places};
    const Series& named = series.at(key);
    auto loaded = loadSeries(named, job.progress(), job.cancel());
    if (!loaded) return loaded.error();
    return ShapesVolume{named, loaded->drawn, loaded->origins, loaded->places};
  }
};

MeasuredStudy measuredIn(const Session& session, const Study& study, const std::string& studyUid) {
  MeasuredStudy all{study, {}, {}, {}, {}};
  for (const Measurement& m : session.workspace().measurements) {
    const Series& series = *session.workspace().series.at(m.series).series;
    if (series.studyUid != studyUid) continue;
    const std::string kind = ruleOf(m.shape.kind).name;
    all.shapes.push_back(
        {m.shape, m.shape.name.empty() ? kind : kind + " \"" + m.shape.name + "\"", nullptr});
    all.of.push_back(m.series);
    if (m.shape.frame) continue;
    all.series.insert_or_assign(m.series, series);
    if (const LoadedSeriesPtr held = session.seriesNamed(m.series)) all.held[m.series] = held;
  }
  return all;
}

using VolumesOfShapes = std::map<SeriesKey, ShapesVolume>;

// Reads the volumes that shapes in space are measured in. The shapes refer to the result.
Result<VolumesOfShapes> readVolumes(MeasuredStudy& measured, const Job& job) {
  VolumesOfShapes volumes;
  for (std::size_t n = 0; n < measured.shapes.size(); ++n) {
    if (measured.shapes[n].shape.frame) continue;
    const SeriesKey& key = measured.of[n];
    if (!volumes.contains(key)) {
      auto volume = measured.volumeOf(key, job);
      if (!volume) return volume.error();
      volumes.emplace(key, *std::move(volume));
    }
    measured.shapes[n].volume = &volumes.at(key);
  }
  return volumes;
}

Result<LeavingFiles> reported(MeasuredStudy measured, const std::string& path, const Job& job) {
  const auto volumes = readVolumes(measured, job);
  if (!volumes) return volumes.error();
  std::vector<Series> series = frameSeries(measured.study);
  series.insert(series.end(), measured.study.volumes.begin(), measured.study.volumes.end());
  FramesToMeasure frames(std::move(series));
  const auto made = reportOfShapes(measured.shapes, measured.study, frames, job.cancel());
  if (!made)
    return Error{made.message().empty() ? tr("No measurement has a number.").toStdString() : made.message()};
  const auto source =
      readDocumentSource(measured.study, instancesOf(made->report), job.progress(), job.cancel());
  if (!source) return source.error();
  const auto notes = writeReport(made->report, *source, path);
  if (!notes) return notes.error();
  return LeavingFiles{{path}, texts(made->notes) + texts(*notes)};
}

Result<LeavingFiles> presented(MeasuredStudy measured, const SeriesPictures& pictures,
                               const std::optional<Window>& window, const std::string& path, const Job& job) {
  const auto volumes = readVolumes(measured, job);
  if (!volumes) return volumes.error();
  auto shown = greysOfPictures(pictures, window, job.cancel());
  if (!shown) return shown.error();
  if (Status s = drawShapes(measured.shapes, pictures, *shown, job.cancel()); !s) return s.error();
  ObjectTags tags;
  tags.description = "Presentation state";
  tags.seriesNumber = nextSeriesNumber(measured.study, pictures.series.studyUid);
  const auto notes = writePresentationState(shown->presentation, pictures.series, shown->first, tags, path,
                                            job.progress(), job.cancel());
  if (!notes) return notes.error();
  return LeavingFiles{{path}, texts(shown->notes) + texts(*notes)};
}

FileOffer offerOfMeasurements(const MeasuredStudy& measured) {
  const QString name = QStringLiteral("measurements");
  return {tr("The measurements of its study as a structured report"), name,
          [measured, name](const QString& folder, const Job& job) {
            return reported(measured, pathIn(folder, name), job);
          }};
}

FileOffer offerOfKeyImages(const std::vector<ReferencedPicture>& pictures, const Study& study) {
  const QString name = QStringLiteral("key-images");
  return {tr("The key images of its study as a list for archives"), name,
          [pictures, study, name](const QString& folder, const Job& job) -> Result<LeavingFiles> {
            std::vector<std::string> uids;
            for (const ReferencedPicture& one : pictures) uids.push_back(one.sopInstanceUid);
            const auto source = readDocumentSource(study, uids, job.progress(), job.cancel());
            if (!source) return source.error();
            const std::string path = pathIn(folder, name);
            if (Status s = writeKeyObjects({keyObjectTitles().front(), {}, pictures}, *source, path); !s)
              return s.error();
            return LeavingFiles{{path}};
          }};
}

std::vector<ReferencedPicture> keyImagesIn(const Session& session, const std::string& studyUid) {
  std::vector<ReferencedPicture> pictures;
  for (const KeyImage& image : session.workspace().keyImages) {
    if (session.workspace().series.at(image.series).series->studyUid != studyUid) continue;
    auto known = std::ranges::find(pictures, image.sopInstanceUid, &ReferencedPicture::sopInstanceUid);
    if (known == pictures.end()) known = pictures.insert(known, {image.sopInstanceUid, {}, {}, {}});
    if (std::ranges::find(known->frames, image.frame) == known->frames.end())
      known->frames.push_back(image.frame);
    std::ranges::sort(known->frames);
  }
  return pictures;
}

}  // namespace

Study openStudyOf(const OpenStudies& open, const Series& series) {
  std::vector<const Study*> studies;
  for (const OpenStudy& each : open.all()) studies.push_back(each.study.get());
  return studyOfUid(studies, series.studyUid);
}

std::vector<FileOffer> offersOf(const Series& shown, const std::vector<SegmentMap>& maps,
                                const Session& session, const OpenStudies& open) {
  const auto name = [](const char* text) { return QString::fromLatin1(text); };
  std::vector<FileOffer> offers{
      offerOfFiles(tr("The series in the view"), name("series"), openFilesOf(open, shown, false)),
      offerOfFiles(tr("All open series of its study"), name("study"), openFilesOf(open, shown, true))};
  const Study study = openStudyOf(open, shown);
  offers[0].hasFace = FacelessSeries::mayBeOf(shown);
  offers[1].hasFace = std::ranges::any_of(study.volumes, FacelessSeries::mayBeOf);
  if (!maps.empty()) {
    offers.push_back(offerOfSegmentation(maps, shown));
    offers.push_back(offerOfStructureSet(maps, shown, study));
  }
  if (const MeasuredStudy measured = measuredIn(session, study, shown.studyUid); !measured.shapes.empty())
    offers.push_back(offerOfMeasurements(measured));
  if (const auto pictures = keyImagesIn(session, shown.studyUid); !pictures.empty())
    offers.push_back(offerOfKeyImages(pictures, study));
  return offers;
}

FileOffer offerOfPresentation(const Series& shown, const std::optional<Window>& window,
                              const Session& session, const OpenStudies& open) {
  const QString name = QStringLiteral("presentation");
  SeriesPictures pictures{shown, std::vector<int>(shown.files.size())};
  std::iota(pictures.indices.begin(), pictures.indices.end(), 0);
  MeasuredStudy measured = measuredIn(session, openStudyOf(open, shown), shown.studyUid);
  for (std::size_t n = measured.shapes.size(); n-- > 0;)
    if (measured.of[n] != keyOf(shown)) {
      measured.shapes.erase(measured.shapes.begin() + std::ptrdiff_t(n));
      measured.of.erase(measured.of.begin() + std::ptrdiff_t(n));
    }
  return {tr("Window and measurements of the series as a presentation state"), name,
          [measured, pictures, window, name](const QString& folder, const Job& job) {
            return presented(measured, pictures, window, pathIn(folder, name), job);
          }};
}

FileOffer offerOfSlices(const LoadedSeriesPtr& shown, const SlicePlane& plane, int seriesNumber) {
  const VoxelGeometry& geometry = shown->volume->geometry();
  SlicePlane through = planeAlong(geometry, plane.right, plane.down);
  through.slabMm = plane.slabMm, through.slabMode = plane.slabMode;
  through.interpolation = plane.interpolation;
  through.size = sizeToCover(geometry, through);
  const double distanceMm = plane.slabMm > 0 ? plane.slabMm : wheelStep(geometry, plane.normal());
  const auto make = [=](const QString& folder, const Job& job) -> Result<LeavingFiles> {
    const auto stack = stackThrough(shown->volume->geometry(), through, distanceMm);
    if (!stack) return stack.error();
    const auto made = resampleStack(*shown->volume, *stack, job.progress(), job.cancel());
    if (!made) return made.error();
    const Loaded loaded{shown->volume, shown->volume, {}, {}, shown->origins, shown->places};
    auto tags = readDicomTags(shown->series, loaded, job.progress(), job.cancel());
    if (!tags) return tags.error();
    const QString into = folder + QStringLiteral("/slices");
    const auto notes =
        writeDicomSeries(*made->volume, stackTags(*std::move(tags), loaded, *stack, seriesNumber),
                         into.toStdString(), job.progress(), job.cancel());
    if (!notes) return notes.error();
    LeavingFiles leaving{{}, texts(*notes)};
    for (const QString& name : QDir(into).entryList(QDir::Files, QDir::Name))
      leaving.files.push_back((into + QLatin1Char('/') + name).toStdString());
    return leaving;
  };
  FileOffer slices{tr("All slices like that in the view as a new series"), QStringLiteral("slices"), make};
  slices.hasFace = FacelessSeries::mayBeOf(shown->series);
  return slices;
}

}  // namespace volumen
