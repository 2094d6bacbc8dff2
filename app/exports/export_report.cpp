#include "app/exports/exports.h"

#include "app/measured_shapes.h"
#include "io/export/report_dicom.h"
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

}  // namespace

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

}  // namespace volumen
