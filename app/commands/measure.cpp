#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/usage.h"
#include "io/regular_file.h"
#include "viewer/measure/shape_json.h"

namespace volumen {

namespace {

struct MeasureOptions {
  std::string path, shapes, series;
};

Result<std::vector<Shape>> readShapes(const std::string& path) {
  constexpr std::uint64_t mostBytes = 16 << 20;
  const auto file = RegularFile::open(path);
  if (!file) return Error{"Cannot read the shapes " + path + ": " + file.message() + "."};
  std::vector<std::uint8_t> text;
  if (const Status read = file->readUpTo(text, mostBytes); !read)
    return Error{"Cannot read the shapes " + path + ": " + read.message() + "."};
  Result<std::vector<Shape>> shapes = shapesFromJson({text.begin(), text.end()});
  if (!shapes) return Error{path + ": " + shapes.message()};
  return shapes;
}

int run(const MeasureOptions& options, const CancelToken& cancel) {
  const Result<std::vector<Shape>> shapes = readShapes(options.shapes);
  if (!shapes) return fail(shapes.message());
  Result<Opened> opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  const Volume& volume = *opened->loaded.drawn;
  if (opened->loaded.drawn != opened->loaded.acquired)
    opened->notes.push_back("Measured on the evenly spaced slices that are shown in 3D: " +
                            std::to_string(volume.size().z) + ".");
  if (!volume.geometry().calibrated)
    opened->notes.push_back("Not calibrated: lengths are in pixels, volumes in voxels.");
  nlohmann::ordered_json all{{"series", opened->series.id},
                             {"measurements", nlohmann::ordered_json::array()}};
  for (const Shape& shape : *shapes) {
    const Result<Measured> measured = measure(shape, volume, opened->series.unit, cancel);
    if (cancel.cancelled()) return fail({}, cancel);
    all["measurements"].push_back(measuredToJson(shape, measured));
  }
  printNotes(opened->notes);
  std::cout << all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  return exitDone;
}

}  // namespace

std::function<int()> makeMeasure(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<MeasureOptions>();
  addPath(app, options->path)->required();
  app.add_option("--roi", options->shapes,
                 "The shapes to measure, in patient mm, as JSON: a list of {\"kind\", \"points\", \"plane\"}")
      ->type_name("FILE")
      ->required();
  addSeries(app, options->series);
  addExamples(app, {"volumen measure scans/ --roi shapes.json",
                    "volumen measure scans/ --series 1 --roi shapes.json"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
