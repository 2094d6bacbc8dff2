#include "results/numbers/shapes_report.h"

#include <algorithm>
#include <map>

#include "io/export/document_dicom.h"
#include "viewer/measure/shape.h"

namespace volumen {

namespace {

class Reporter {
 public:
  explicit Reporter(const Study& study) : study_(study) {}

  Status add(const ShapeToMeasure& one, const MeasuredShape& measured) {
    if (ruleOf(one.shape.kind).numberless) {
      made.notes.push_back(one.name + " has no number and is left out of the report.");
      return {};
    }
    return one.volume ? addInVolume(one, measured) : addOnFrame(one, measured);
  }

  ShapesReport made;

 private:
  Status addInVolume(const ShapeToMeasure& one, const MeasuredShape& in) {
    const ShapesVolume& volume = *one.volume;
    if (!tiled_.contains(&volume)) {
      const auto tiled = isMosaic(study_, volume.series);
      if (!tiled) return tiled.error();
      tiled_[&volume] = *tiled;
    }
    return addGroup(one, in.measured, placeIn(volume, tiled_[&volume]));
  }

  Status addOnFrame(const ShapeToMeasure& one, const MeasuredShape& on) {
    if (Status s = addGroup(one, on.measured, placeOn(on)); !s) return s;
    if (const auto& frame = on.measured->frame; frame && !frame->calibration.empty())
      made.notes.push_back(one.name + ": its mm are " + frame->calibration +
                           ", which the report does not say.");
    for (const Unread& each : on.series->unread)
      if (std::ranges::find(made.unread, each.path, &Unread::path) == made.unread.end())
        made.unread.push_back(each);
    return {};
  }

  Status addGroup(const ShapeToMeasure& one, const Result<Measured>& measured, const MeasuredOn& on) {
    if (!measured) return measured.error();
    const auto group = reportedShape(one.shape, *measured, on);
    if (!group) return Error{group.message() + "."};
    made.report.groups.push_back(*group);
    return {};
  }

  const Study& study_;
  std::map<const ShapesVolume*, bool> tiled_;
};

}  // namespace

Result<bool> isMosaic(const Study& study, const Series& series) {
  const auto& uids = series.sopInstanceUids;
  if (uids.size() < 2 || uids[0] != uids[1] || series.files[0] != series.files[1]) return false;
  const auto source = readDocumentSource(study, std::span(uids).first(1));
  if (!source) return source.error();
  return source->pictures.at(uids[0]).frames == 1;
}

Result<ShapesReport> reportOfShapes(std::span<const ShapeToMeasure> shapes, const Study& study,
                                    FramesToMeasure& frames, const CancelToken& cancel) {
  const auto measured = measuredShapes(shapes, frames, cancel);
  Reporter reporter(study);
  for (std::size_t n = 0; n < shapes.size(); ++n)
    if (Status s = reporter.add(shapes[n], measured[n]); !s)
      return Error{shapes[n].name + ": " + s.message()};
  if (reporter.made.report.groups.empty()) return Error{};
  return std::move(reporter.made);
}

Study studyOfUid(std::span<const Study* const> open, const std::string& studyUid) {
  Study all;
  const auto add = [&](const auto& from, auto& to) {
    for (const auto& one : from)
      if (one.studyUid == studyUid) to.push_back(one);
  };
  for (const Study* study : open) {
    add(study->volumes, all.volumes);
    add(study->images, all.images);
    add(study->derived, all.derived);
  }
  return all;
}

}  // namespace volumen
