#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/output_names.h"
#include "app/recipe_word.h"
#include "app/segment_numbers.h"
#include "app/segment_text.h"
#include "app/usage.h"
#include "io/export/export_segments.h"
#include "results/segments/recipes.h"
#include "viewer/recipe/recipe.h"
#include "viewer/recipe/step_names.h"
#include "viewer/scene/similar_name.h"
#include "viewer/segment/names_and_colours.h"

namespace volumen {

namespace {

constexpr glm::u8vec3 boneIvory{240, 219, 163};

struct SegmentCommandOptions {
  std::string path, range, recipe, from, output, series, csv;
  bool json = false, removeTable = false, largestPart = false;
  SurfaceWriting surfaces;
};

// The source of segments: a recipe or a file.
struct SegmentSource {
  std::optional<Recipe> recipe{};
  std::string file{};
};

// Parses an end of the range; an empty text gives `open`.
std::optional<double> readEnd(const std::string& text, double open) {
  if (text.empty()) return open;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

// Parses "A:B", "A:" or ":B" with A <= B.
std::optional<ValueRange> readRange(const std::string& text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text == ":") return {};
  const auto low = readEnd(text.substr(0, colon), -infinity),
             high = readEnd(text.substr(colon + 1), infinity);
  if (!low || !high || *low > *high) return {};
  return ValueRange{*low, *high};
}

// Returns a recipe of one range of values.
Result<Recipe> recipeOfRange(const SegmentCommandOptions& options) {
  const auto range = readRange(options.range);
  if (!range)
    return Error{"--range: \"" + options.range +
                 "\" is not LOW:HIGH, LOW: or :HIGH with LOW not above HIGH, as in 150:3000."};
  Recipe recipe{"Range " + options.range, {}, {}, {}, {}};
  const std::string& name = recipe.name;
  recipe.segments = {{.number = 1, .label = name, .colour = boneIvory, .range = range}};
  recipe.steps = {{"range", name, {{"low", range->low}, {"high", range->high}}}};
  return recipe;
}

bool isFile(const std::string& recipe) {
  return recipe.ends_with(".json") || recipe.find('/') != std::string::npos;
}

Result<Recipe> recipeNamed(const std::string& name) {
  if (isFile(name)) return recipeFromFile(name);
  std::vector<std::string> words;
  for (const Recipe& recipe : builtInRecipes()) {
    if (recipeWord(recipe) == name) return recipe;
    words.push_back(recipeWord(recipe));
  }
  const auto meant = similarName(name, words);
  return Error{"There is no recipe \"" + name + "\"" + (meant ? "; did you mean \"" + *meant + "\"?" : ".") +
               " `volumen segment --list-recipes` shows all; a file's name ends in .json."};
}

// Intersects all segments with the patient, which excludes the table.
void removeTable(Recipe& recipe) {
  recipe.steps.insert(recipe.steps.begin(), {"patient", "Patient"});
  for (const Segment& segment : recipe.segments)
    recipe.steps.push_back({"intersect", segment.label, {{"other", std::string("Patient")}}});
}

void printJson(const SegmentNumbersTold& numbers, const Opened& opened, const SegmentSource& source,
               const std::vector<std::string>& files) {
  nlohmann::ordered_json all{{"series", opened.series.id}};
  if (source.recipe) {
    all["recipe"] = nlohmann::ordered_json::parse(recipeJson(*source.recipe));
    all["recipeUnit"] = opened.series.unit;
  } else {
    all["from"] = pathForJson(source.file);
  }
  addSegments(all, numbers);
  all["files"] = nlohmann::ordered_json::array();
  for (const std::string& file : files) all["files"].push_back(pathForJson(file));
  all["warnings"] = opened.notes;
  all["unread"] = unreadJson(opened.loaded.unread);
  std::cout << jsonText(all);
}

void addNotes(Opened& opened, const SegmentSource& source, const SegmentNumbersTold& numbers) {
  if (source.recipe && numbers.scale.factor != 1 && std::ranges::any_of(source.recipe->steps, namesValue))
    opened.notes.push_back("Values that were given are in " + opened.series.unit +
                           ", the unit of the file; numbers are told in " + numbers.scale.unit + ".");
  if (opened.loaded.drawn != opened.loaded.acquired)
    opened.notes.push_back("Segments have the evenly spaced slices that are shown in 3D: " +
                           std::to_string(opened.loaded.drawn->size().z) + ".");
  addSegmentNotes(opened, numbers.reports);
}

// Returns one map; several for a file with overlapping segments.
Result<SegmentsFile> segmentsOf(const SegmentSource& source, Opened& opened, const CancelToken& cancel) {
  if (!source.recipe) return segmentsOfFile(source.file, opened, cancel);
  auto made = follow(*source.recipe, *opened.loaded.drawn, cancel, acquiredSlicesOf(opened.loaded));
  if (!made) return Error{source.recipe->name + ": " + made.message()};
  for (const std::string& note : notesOf(*source.recipe, opened.series)) opened.notes.push_back(note);
  SegmentsFile all;
  all.maps.push_back(std::move(*made));
  addColours(all.maps);
  return all;
}

// Protects all files that are read or written by the command. Only a file of segments may replace itself.
Status checkNames(const SegmentCommandOptions& options, const SegmentsFile& segments, const Series& series) {
  auto written = options.output.empty() ? std::vector<std::string>()
                                        : filesOfExport(options.output, segments.maps, options.surfaces);
  if (!written) return written.error();
  std::vector<std::string> read = series.files;
  const bool replaces = !options.from.empty() && !checkApart({&options.output, 1}, {&options.from, 1});
  if (isFile(options.recipe)) read.push_back(options.recipe);
  if (!replaces) read.insert(read.end(), segments.files.begin(), segments.files.end());
  if (!options.csv.empty()) written->push_back(options.csv);
  if (Status s = checkApart(*written, read); !s || options.csv.empty()) return s;
  return checkApart({&options.csv, 1}, segments.files);
}

// Writes nothing if only numbers are requested.
Result<ExportedSegments> exportedOf(const SegmentCommandOptions& options, const SegmentsFile& segments,
                                    const Series& series, const CancelToken& cancel) {
  if (options.output.empty()) return ExportedSegments();
  std::vector<Segmented> maps = segments.maps;
  if (options.largestPart)
    for (Segmented& map : maps) map = withLargestParts(map, cancel);
  return exportSegments(options.output, maps, series, {}, cancel, options.surfaces);
}

// Checks that the output format exists, and that it has surfaces if an option requires them.
Status checkFormat(const SegmentCommandOptions& options) {
  const SegmentFormat* format = nullptr;
  if (!options.output.empty()) {
    const auto found = segmentFormatOf(options.output);
    if (!found) return found.error();
    format = *found;
  }
  for (const auto& [isGiven, option] : {std::pair(options.surfaces.reducedByMm > 0, "--reduce"),
                                        std::pair(options.surfaces.inOneFile, "--one-file"),
                                        std::pair(options.largestPart, "--largest-part")})
    if (isGiven && !(format && format->isSurface))
      return Error{std::string(option) + " goes with surfaces: -o FILE.stl, .ply or .obj."};
  return {};
}

int work(const SegmentCommandOptions& options, SegmentSource source, const CancelToken& cancel) {
  for (const std::string& path : {options.output, options.csv})
    if (auto file = OutputFile::create(path); !path.empty() && !file) return fail(file.message());
  Result<Opened> opened = openVolume(options.path, options.series, cancel, segmenting);
  if (!opened) return fail(opened.message(), cancel);
  if (options.removeTable) {
    if (Status s = checkHounsfield(*opened); !s) return fail(s.message());
    removeTable(*source.recipe);
  }
  noteKeptTilt(*opened);
  const auto segments = segmentsOf(source, *opened, cancel);
  if (!segments) return fail(segments.message(), cancel);
  if (Status s = checkNames(options, *segments, opened->series); !s) return fail(s.message());
  // Measuring surfaces takes long: with an output file they are measured only for --json or --csv.
  const NumbersWanted wanted{.surfaces = options.json || !options.csv.empty() || options.output.empty(),
                             .overTime = options.json};
  const auto numbers = numbersTold(segments->maps, *opened, PetUnit::suvBodyWeight, wanted, cancel);
  if (!numbers) return fail(numbers.message(), cancel);
  auto csv = writeCsv(options.csv, *numbers);
  if (!csv) return fail(csv.message());
  const auto exported = exportedOf(options, *segments, opened->series, cancel);
  if (!exported) return fail(exported.message(), cancel);
  std::vector<std::string> files = exported->files;
  if (*csv) {
    if (Status s = (*csv)->commit(); !s) return fail(s.message());
    files.push_back(options.csv);
  }
  addNotes(*opened, source, *numbers);
  opened->notes.insert(opened->notes.end(), exported->notes.begin(), exported->notes.end());
  printNotes(opened->notes);
  if (options.json) {
    printJson(*numbers, *opened, source, files);
  } else {
    std::cout << segmentsText(numbers->reports, numbers->scale, wanted.surfaces);
    for (const std::string& file : files) std::cout << "file: " << printable(file) << '\n';
  }
  return opened->status();
}

int run(const SegmentCommandOptions& options, const CancelToken& cancel) {
  const int given = !options.range.empty() + !options.recipe.empty() + !options.from.empty();
  if (given != 1) return failUsage("Give one of --range LOW:HIGH, --recipe NAME and --from FILE.");
  if (Status s = checkFormat(options); !s) return failUsage(s.message());
  if (!options.from.empty()) {
    if (options.removeTable) return failUsage("--remove-table goes with --range and --recipe.");
    return work(options, {{}, options.from}, cancel);
  }
  Result<Recipe> recipe = options.recipe.empty() ? recipeOfRange(options) : recipeNamed(options.recipe);
  if (!recipe) return isFile(options.recipe) ? fail(recipe.message()) : failUsage(recipe.message());
  return work(options, {std::move(*recipe), {}}, cancel);
}

void addListRecipes(CLI::App& app) {
  const auto list = [] {
    for (const Recipe& recipe : builtInRecipes())
      std::cout << recipeWord(recipe) << "\n    " << recipe.description << '\n';
    throw CLI::Success();
  };
  app.add_flag_callback("--list-recipes", list, "List the built-in recipes");
}

}  // namespace

std::function<int()> makeSegment(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<SegmentCommandOptions>();
  addPath(app, options->path)->required();
  app.add_option(
         "--range", options->range,
         "Values to segment, both ends included, in the unit of the file (HU for CT): LOW:HIGH, LOW: or "
         ":HIGH")
      ->type_name("LOW:HIGH");
  app.add_option("--recipe", options->recipe, "A recipe by name, or a file that ends in .json")
      ->type_name("NAME");
  addListRecipes(app);
  app.add_option(
         "--from", options->from,
         "Segments of a file, brought to the grid of PATH: a DICOM segmentation, .seg.nrrd, or an image "
         "of labels")
      ->type_name("FILE");
  app.add_option(
         "-o,--output", options->output,
         "The file to write; none: numbers alone. It is .seg.nrrd (3D Slicer), .dcm (DICOM segmentation), "
         ".nii.gz or .mha (labels, and a table of names beside them), .stl, .ply or .obj (surfaces)")
      ->type_name("FILE");
  addSeries(app, options->series);
  number(
      app.add_option(
          "--reduce", options->surfaces.reducedByMm,
          "Surfaces with fewer triangles, none of them farther off than about so many mm; they stay closed"),
      0.001, 100);
  app.add_flag("--one-file", options->surfaces.inOneFile,
               "The surfaces of all segments in one file, in place of a file a segment");
  app.add_flag("--largest-part", options->largestPart,
               "Surfaces of the largest part of each segment alone; the notes tell how many closed shells "
               "there are");
  app.add_flag("--remove-table", options->removeTable,
               "CT: segment the patient alone, without table, cushions and cables");
  app.add_option("--csv", options->csv, "Write the numbers of all segments, a row each")->type_name("FILE");
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen segment scans/ --recipe bone -o bone.stl",
                    "volumen segment scans/ --range :-300 --csv air.csv -o air.seg.nrrd"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
