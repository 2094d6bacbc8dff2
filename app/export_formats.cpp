#include "app/export_formats.h"

#include <algorithm>
#include <charconv>

#include "app/measured_shapes.h"
#include "app/segment_numbers.h"
#include "io/export/key_objects_dicom.h"
#include "io/export/report_dicom.h"
#include "io/export/rtstruct.h"
#include "io/paths/open_path.h"
#include "results/numbers/report_of_shapes.h"

namespace volumen {

namespace {

// Returns "[2] (length "lesion")", as error messages of shapes count.
std::string shapeWords(const std::vector<Shape>& shapes, std::size_t n) {
  const std::string name = shapes[n].name.empty() ? "" : " \"" + shapes[n].name + "\"";
  return "[" + std::to_string(n) + "] (" + ruleOf(shapes[n].kind).name + name + ")";
}

// A mosaic holds all slices in one image without frames.
Result<bool> isMosaic(const Study& study, const Series& series) {
  const auto& uids = series.sopInstanceUids;
  if (uids.size() < 2 || uids[0] != uids[1]) return false;
  const auto source = readDocumentSource(study, std::span(uids).first(1));
  if (!source) return source.error();
  return source->pictures.at(uids[0]).frames == 1;
}

/// Measures shapes and collects them in a report.
class ShapesToReport {
 public:
  ShapesToReport(const ExportJob& job, const std::vector<Shape>& shapes, const ShapeSources& sources,
                 const CancelToken& cancel)
      : job_(job), shapes_(shapes), sources_(sources), cancel_(cancel) {}

  // The Error names the first shape that the report cannot hold.
  Status run(const Study& study) {
    if (const auto& opened = sources_.volume) {
      const auto scale = scaleFor(opened->series, {});
      const auto tiled = isMosaic(study, opened->series);
      if (!scale) return scale.error();
      if (!tiled) return tiled.error();
      scale_ = *scale, isTiled_ = *tiled;
    }
    for (std::size_t n = 0; n < shapes_.size() && !cancel_.cancelled(); ++n)
      if (Status s = add(n); !s)
        return Error{job_.shapes + ": " + shapeWords(shapes_, n) + ": " + s.message()};
    if (report.groups.empty()) return Error{job_.shapes + ": No shape in it has a number."};
    return {};
  }

  Report report;
  Exported exported;

 private:
  Status add(std::size_t n) {
    const Shape& shape = shapes_[n];
    if (ruleOf(shape.kind).numberless) {
      exported.notes.push_back(shapeWords(shapes_, n) + " has no number and is left out of the report.");
      return {};
    }
    const MeasuredShape one = measuredShape(shape, sources_, scale_, {}, cancel_);
    if (!one.measured) return one.measured.error();
    const auto group = reportedShape(shape, *one.measured, placeOf(one));
    if (!group) return Error{group.message() + "."};
    report.groups.push_back(*group);
    if (one.series) addUnread(exported.unread, one.series->unread);
    if (const auto& frame = one.measured->frame; frame && !frame->calibration.empty())
      exported.notes.push_back(shapeWords(shapes_, n) + ": its mm are " + frame->calibration +
                               ", which the report does not say.");
    return {};
  }

  ReportedOn placeOf(const MeasuredShape& one) const {
    if (one.series) return {one.series, {}, {}, {}, false, one.frame, one.pixelMm};
    const Opened& opened = *sources_.volume;
    const Loaded& loaded = opened.loaded;
    return {&opened.series, loaded.drawn->geometry(), loaded.origins, loaded.places, isTiled_};
  }

  const ExportJob& job_;
  const std::vector<Shape>& shapes_;
  const ShapeSources& sources_;
  const CancelToken& cancel_;
  ValueScale scale_;
  bool isTiled_ = false;
};

Result<Exported> exportReport(const ExportJob& job, const CancelToken& cancel) {
  const auto shapes = readShapes(job.shapes);
  if (!shapes) return shapes.error();
  const auto sources = openForShapes(job.path, job.series, *shapes, false, {}, cancel);
  if (!sources) return sources.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  ShapesToReport made(job, *shapes, *sources, cancel);
  if (sources->volume) {
    made.exported.notes = sources->volume->notes;
    made.exported.unread = sources->volume->loaded.unread;
  }
  if (Status s = made.run(*study); !s) return s.error();
  if (Status s = checkLosses(job.path, made.exported.unread); !s) return s.error();
  const auto source = readDocumentSource(*study, instancesOf(made.report), {}, cancel);
  if (!source) return source.error();
  const auto notes = writeReport(made.report, *source, job.output);
  if (!notes) return notes.error();
  made.exported.notes.insert(made.exported.notes.end(), notes->begin(), notes->end());
  return made.exported;
}

// Adds an image of the list, "UID" or "UID/FRAME". One that is named without frame stands for all frames.
Status addImage(const std::string& word, std::vector<ReferencedPicture>& all) {
  const std::size_t slash = word.find('/');
  const std::string uid = word.substr(0, slash);
  auto known = std::ranges::find(all, uid, &ReferencedPicture::sopInstanceUid);
  const bool isNew = known == all.end();
  if (isNew) known = all.insert(all.end(), {uid, {}, {}, {}});
  if (slash == std::string::npos) return known->frames.clear(), Status();
  int frame = 0;
  const auto [end, error] = std::from_chars(word.data() + slash + 1, word.data() + word.size(), frame);
  if (error != std::errc() || end != word.data() + word.size() || frame < 1)
    return Error{"--images: \"" + word + "\" is not UID or UID/FRAME, with frames from 1."};
  if (!isNew && known->frames.empty()) return {};
  known->frames.push_back(frame - 1);
  std::ranges::sort(known->frames);
  known->frames.erase(std::ranges::unique(known->frames).begin(), known->frames.end());
  return {};
}

Result<std::vector<ReferencedPicture>> imagesIn(const std::string& list) {
  std::vector<ReferencedPicture> all;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (Status s = addImage(list.substr(begin, end - begin), all); !s) return s.error();
    begin = end + 1;
  }
  return all;
}

Result<Exported> exportKeyObjects(const ExportJob& job, const CancelToken& cancel) {
  const auto title = keyObjectTitle(job.title);
  if (!title) return title.error();
  const auto images = imagesIn(job.images);
  if (!images) return images.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  std::vector<std::string> uids;
  for (const ReferencedPicture& picture : *images) uids.push_back(picture.sopInstanceUid);
  const auto source = readDocumentSource(*study, uids, {}, cancel);
  if (!source) return source.error();
  if (Status s = writeKeyObjects({*title, {}, *images}, *source, job.output); !s) return s.error();
  return Exported{};
}

Result<Exported> exportStructureSet(const ExportJob& job, const CancelToken& cancel) {
  auto opened = openVolume(job.path, job.series, cancel, segmenting);
  if (!opened) return opened.error();
  const auto segments = segmentsOfFile(job.segments, *opened, cancel);
  if (!segments) return segments.error();
  if (Status s = checkLosses(job.path, opened->loaded.unread); !s) return s.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  StructureSetTags tags;
  tags.description = "Segments";
  tags.seriesNumber = nextSeriesNumber(*study, opened->series.studyUid);
  const auto notes = writeStructureSet(segments->maps, opened->series, tags, job.output, {}, cancel);
  if (!notes) return notes.error();
  Exported exported{opened->notes, opened->loaded.unread};
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  return exported;
}

}  // namespace

std::span<const ExportFormat> exportFormats() {
  static const ExportFormat formats[] = {{"sr",
                                          "measurements as a DICOM structured report (TID 1500)",
                                          &ExportJob::shapes,
                                          {&ExportJob::series},
                                          exportReport},
                                         {"ko",
                                          "key images as a DICOM key object selection",
                                          &ExportJob::images,
                                          {&ExportJob::title},
                                          exportKeyObjects},
                                         {"rtstruct",
                                          "segments as an RT Structure Set",
                                          &ExportJob::segments,
                                          {&ExportJob::series},
                                          exportStructureSet}};
  return formats;
}

}  // namespace volumen
