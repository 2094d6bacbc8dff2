#include <algorithm>
#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/measured_shapes.h"
#include "app/open_volume.h"
#include "app/output_names.h"
#include "app/segment_numbers.h"
#include "app/usage.h"
#include "results/numbers/segment_report.h"
#include "results/numbers/series_columns.h"
#include "viewer/measure/shape_json.h"

namespace volumen {

namespace {

struct MeasureOptions {
  std::string path, shapes, segments, csv, series, unit;
};

// Converts a shape to JSON; its range gets the same unit as its other numbers.
nlohmann::ordered_json jsonOf(Shape shape, const Result<Measured>& measured, double factor) {
  shape.range.low *= factor, shape.range.high *= factor;
  return measuredToJson(shape, measured);
}

// Returns the unreadable files of everything that shapes are measured on.
std::vector<Unread> unreadOf(const std::optional<Opened>& opened, const std::vector<const Series*>& frames) {
  std::vector<Unread> all;
  if (opened) all = opened->loaded.unread;
  for (const Series* series : frames) addUnread(all, series->unread);
  return all;
}

void addNotes(Opened& opened, const ValueScale& scale, bool hasShapes) {
  const Volume& volume = *opened.loaded.drawn;
  if (opened.loaded.drawn != opened.loaded.acquired)
    opened.notes.push_back("Measured on the evenly spaced slices that are shown in 3D: " +
                           std::to_string(volume.size().z) + ".");
  if (hasShapes && !volume.geometry().calibrated)
    opened.notes.push_back("Not calibrated: lengths are in pixels, volumes in voxels.");
  if (!scale.why.empty())
    opened.notes.push_back("Values are in " + (scale.unit.empty() ? "no known unit" : scale.unit) + ", " +
                           scale.why + ".");
}

// `used` receives the series of the measured images.
nlohmann::ordered_json measurementsOf(const std::vector<Shape>& shapes, ShapeSources& sources,
                                      const ValueScale& scale, const MeasureOptions& options,
                                      std::vector<const Series*>& used, const CancelToken& cancel) {
  const ShapesVolume volume = volumeOf(sources);
  const auto scaleOf = [&](const Series& series) { return scaleFor(series, options.unit); };
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  const auto measured = measuredShapes(shapesToMeasure(shapes, volume), sources.frames, scaleOf, cancel);
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    if (measured[n].series) used.push_back(measured[n].series);
    all.push_back(jsonOf(shapes[n], measured[n].measured, scale.factor));
  }
  return all;
}

// Adds the segments' numbers to the JSON and to the requested CSV, and notes about them to `opened`.
Status measureSegments(nlohmann::ordered_json& all, Opened& opened, const MeasureOptions& options,
                       const CancelToken& cancel) {
  const auto segments = segmentsOfFile(options.segments, opened, cancel);
  if (!segments) return segments.error();
  std::vector<std::string> read = opened.series.files;
  read.insert(read.end(), segments->files.begin(), segments->files.end());
  read.push_back(options.shapes);
  if (!options.csv.empty())
    if (Status s = checkApart({&options.csv, 1}, read); !s) return s;
  const auto numbers =
      numbersTold(segments->maps, opened, petUnitOf(options.unit), {.overTime = true}, cancel);
  if (!numbers) return numbers.error();
  addSegments(all, *numbers);
  addSegmentNotes(opened, numbers->reports);
  auto csv = writeCsv(options.csv, *numbers);
  if (!csv) return csv.error();
  return *csv ? (*csv)->commit() : Status();
}

int work(const MeasureOptions& options, const std::vector<Shape>& shapes, const CancelToken& cancel) {
  const bool hasSegments = !options.segments.empty();
  const Result<Study> study = openStudyAt(options.path, cancel);
  if (!study) return fail(study.message(), cancel);
  Result<ShapeSources> sources =
      openForShapes(*study, options.path, options.series, shapes, hasSegments || shapes.empty(),
                    hasSegments ? segmenting : MemoryUse(), cancel);
  if (!sources) return fail(sources.message(), cancel);
  std::optional<Opened>& opened = sources->volume;
  nlohmann::ordered_json all;
  const Result<ValueScale> scale = opened ? scaleFor(opened->series, options.unit) : ValueScale{};
  if (!scale) return fail(scale.message());
  if (opened) {
    all["series"] = opened->series.id;
    all["of"] = identityJson(seriesFields(opened->series, timePointOf(opened->series)));
  }
  if (!scale->why.empty()) all["noSuv"] = scale->why;
  const bool hasShapes = !options.shapes.empty();
  std::vector<const Series*> used;
  if (hasShapes) all["measurements"] = measurementsOf(shapes, *sources, *scale, options, used, cancel);
  if (cancel.cancelled()) return fail({}, cancel);
  const std::vector<Unread> unread = unreadOf(opened, used);
  if (Status whole = checkLosses(options.path, unread); !whole) return fail(whole.message());
  if (opened) addNotes(*opened, *scale, hasShapes);
  if (!options.segments.empty())
    if (Status s = measureSegments(all, *opened, options, cancel); !s) return fail(s.message(), cancel);
  printNotes(opened ? opened->notes : unreadSentences(used));
  if (opened) all["warnings"] = opened->notes;
  all["unread"] = unreadJson(unread);
  std::cout << jsonText(all);
  return statusWith(unread);
}

int run(const MeasureOptions& options, const CancelToken& cancel) {
  if (options.shapes.empty() && options.segments.empty())
    return failUsage("Give --roi FILE, --segments FILE or both.");
  if (!options.csv.empty()) {
    if (options.segments.empty()) return failUsage("--csv goes with --segments FILE.");
    if (auto file = OutputFile::create(options.csv); !file) return fail(file.message());
  }
  const Result<std::vector<Shape>> shapes = readShapes(options.shapes);
  return shapes ? work(options, *shapes, cancel) : fail(shapes.message());
}

}  // namespace

std::function<int()> makeMeasure(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<MeasureOptions>();
  addPath(app, options->path)->required();
  app.add_option("--roi", options->shapes,
                 "The shapes to measure, in patient mm or pixels of a frame, as JSON: a list of {\"kind\", "
                 "\"points\", \"plane\" or \"frame\"}")
      ->type_name("FILE");
  app.add_option("--segments", options->segments,
                 "Segments to measure, brought to the grid of PATH: a DICOM segmentation, .seg.nrrd, or an "
                 "image of labels")
      ->type_name("FILE");
  app.add_option("--csv", options->csv, "Write the numbers of all segments, a row each")->type_name("FILE");
  addSeries(app, options->series);
  oneOf(app.add_option(
            "--unit", options->unit,
            "Values of PET in SUVbw, SUVlbm, SUVbsa or file, that of the file (default: SUVbw, else file)"),
        keys(petUnitWords()))
      ->type_name("UNIT");
  addExamples(app, {"volumen measure scans/ --roi shapes.json",
                    "volumen measure scans/ --segments first.seg.nrrd --csv numbers.csv"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
