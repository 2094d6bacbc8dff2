#include <QImage>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command.h"
#include "app/commands/slice_frame.h"
#include "app/open_volume.h"
#include "app/option_words.h"
#include "app/picture_output.h"
#include "app/usage.h"
#include "io/files/output_file.h"
#include "viewer/slice/first_window.h"
#include "viewer/slice/slice.h"

namespace volumen {

namespace {

const OptionWords<NamedPlane> planes{
    {"axial", NamedPlane::axial}, {"coronal", NamedPlane::coronal}, {"sagittal", NamedPlane::sagittal}};
const char* const framePlane = "frame";  // besides: an image as acquired
const OptionWords<SlabMode> slabModes{
    {"max", SlabMode::max}, {"min", SlabMode::min}, {"mean", SlabMode::mean}};
const OptionWords<Interpolation> interpolations{
    {"linear", Interpolation::linear}, {"nearest", Interpolation::nearest}, {"cubic", Interpolation::cubic}};

// Options as typed.
struct SliceOptions {
  std::string path, series, output, plane = "axial", centre, right, down, size, slabMode = "max",
                                    interpolation = "linear", window, presentation;
  std::optional<double> at, mmPerPixel;
  std::optional<int> index;
  double slabMm = 0;
  bool average = false, printPlane = false, noWarningLine = false, noGraphics = false;
};

// Parsed options, before the volume is known.
struct Asked {
  std::optional<glm::dvec3> centre;
  std::optional<std::pair<glm::dvec3, glm::dvec3>> rightAndDown;  // orthogonal unit vectors
  std::optional<glm::ivec2> size;
  std::optional<Window> window;
};

Result<glm::dvec3> readVector(const std::string& option, const std::string& text) {
  const auto numbers = numbersOf(option, text, 3, "0,0.5,-12");
  if (!numbers) return numbers.error();
  return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Status readDirections(const SliceOptions& options, Asked& asked) {
  if (options.right.empty()) return {};
  const auto right = readVector("--right", options.right), down = readVector("--down", options.down);
  if (!right) return right.error();
  if (!down) return down.error();
  if (!(glm::length(*right) > 0) || !(glm::length(*down) > 0))
    return Error{"--right and --down are directions; 0,0,0 is none."};
  const glm::dvec3 r = glm::normalize(*right), d = glm::normalize(*down);
  if (std::abs(glm::dot(r, d)) > 1e-3) return Error{"--right and --down are not at a right angle."};
  asked.rightAndDown = {r, glm::normalize(d - glm::dot(r, d) * r)};
  return {};
}

Result<Asked> readOptions(const SliceOptions& options) {
  Asked asked;
  if (!options.centre.empty()) {
    const auto centre = readVector("--centre", options.centre);
    if (!centre) return centre.error();
    asked.centre = *centre;
  }
  if (Status s = readDirections(options, asked); !s) return s.error();
  if (!options.size.empty()) {
    const auto size = sizeOf(options.size);
    if (!size) return size.error();
    asked.size = *size;
  }
  if (!options.window.empty()) {
    const auto window = numbersOf("--window", options.window, 2, "40,400");
    if (!window) return window.error();
    if (!((*window)[1] > 0)) return Error{"--window: the width must be above 0."};
    asked.window = Window{(*window)[0], (*window)[1]};
  }
  return asked;
}

// Returns the axis of --at.
int axisOf(NamedPlane plane) { return plane == NamedPlane::axial ? 2 : plane == NamedPlane::coronal ? 1 : 0; }

Result<SlicePlane> onIndex(const SlicePlane& plane, const VoxelGeometry& geometry, int index) {
  if (index >= geometry.size.z)
    return Error{"--index " + std::to_string(index) + ": the slices are 0 to " +
                 std::to_string(geometry.size.z - 1) + "."};
  const auto on = onSlice(plane, geometry, index);
  if (!on)
    return Error{
        "--index: the plane is not parallel to the slices; say where it lies with --at or --centre."};
  return *on;
}

// The Error: the plane or slab does not meet the volume, so the picture would be empty.
Status checkMeets(const SlicePlane& plane, const VoxelGeometry& geometry) {
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;  // along the normal, from the plane
  for (const glm::dvec3& place : geometry.boxCorners()) {
    const double along = glm::dot(place - plane.centre, plane.normal());
    low = glm::min(low, place), high = glm::max(high, place);
    nearest = std::min(nearest, along), farthest = std::max(farthest, along);
  }
  const double reach = 0.5 * plane.slabMm + 1e-6;
  if (nearest <= reach && farthest >= -reach) return {};
  char text[160];
  std::snprintf(text, sizeof text, "x %.1f to %.1f, y %.1f to %.1f, z %.1f to %.1f mm.", low.x, high.x, low.y,
                high.y, low.z, high.z);
  return Error{std::string("The plane lies outside of the volume, which reaches from ") + text};
}

Result<SlicePlane> makePlane(const SliceOptions& options, const Asked& asked, const VoxelGeometry& geometry) {
  const NamedPlane name = meaning(planes, options.plane);
  SlicePlane plane = asked.rightAndDown
                         ? planeAlong(geometry, asked.rightAndDown->first, asked.rightAndDown->second)
                         : namedPlane(geometry, name);
  if (asked.centre) plane.centre = *asked.centre;
  if (options.at) plane.centre[axisOf(name)] = *options.at;
  if (options.mmPerPixel) plane.mmPerPixel = *options.mmPerPixel;
  plane.size = asked.size ? *asked.size : sizeToCover(geometry, plane);
  plane.slabMm = options.slabMm;
  plane.slabMode = meaning(slabModes, options.slabMode);
  plane.interpolation = meaning(interpolations, options.interpolation);
  plane.average = options.average;
  if (!options.index) {
    if (Status meets = checkMeets(plane, geometry); !meets) return meets.error();
    return plane;
  }
  return onIndex(plane, geometry, *options.index);
}

nlohmann::ordered_json planeJson(const SlicePlane& plane) {
  const auto vector = [](glm::dvec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  return {{"centre", vector(plane.centre)},
          {"right", vector(plane.right)},
          {"down", vector(plane.down)},
          {"mmPerPixel", plane.mmPerPixel},
          {"size", {plane.size.x, plane.size.y}},
          {"slabMm", plane.slabMm},
          {"slabMode", wordOf(slabModes, plane.slabMode)},
          {"interpolation", wordOf(interpolations, plane.interpolation)},
          {"average", plane.average}};
}

std::string windowText(const GreyMapping& grey) {
  const nlohmann::json centre = grey.window.centre, width = grey.window.width;
  return (grey.function == WindowFunction::linear ? "LINEAR " : "LINEAR_EXACT ") + centre.dump() + "," +
         width.dump();
}

// Resamples and maps rows as they come: all values at once would be twice a radiograph's memory.
Result<QImage> greyImage(const Volume& volume, const SlicePlane& plane, const GreyMapping& grey,
                         const CancelToken& cancel) {
  QImage image(plane.size.x, plane.size.y, QImage::Format_Grayscale8);
  if (image.isNull()) throw std::bad_alloc();
  const auto width = std::size_t(plane.size.x);
  int y = 0;
  const auto use = [&](std::span<const float> rows) -> Status {
    const std::vector<std::uint8_t> bytes = greyBytes(rows, grey);
    for (std::size_t n = 0; n < bytes.size(); n += width) std::memcpy(image.scanLine(y++), &bytes[n], width);
    return {};
  };
  if (Status s = resampleSliceByRows(volume, plane, use, cancel); !s) return s.error();
  return image;
}

// Returns nothing without calibration.
std::optional<PicturePlane> placeOf(const SlicePlane& plane, const VoxelGeometry& geometry) {
  if (!geometry.calibrated) return {};
  return PicturePlane{plane.patientFromPixel({0.5, 0.5}), plane.right * plane.mmPerPixel,
                      plane.down * plane.mmPerPixel};
}

Status writeValues(const Volume& volume, const SlicePlane& plane, const std::string& path,
                   const CancelToken& cancel) {
  auto out = createMapNrrd(plane.size, path, placeOf(plane, volume.geometry()));
  if (!out) return out.error();
  const auto use = [&](std::span<const float> rows) { return out->write(rows.data(), rows.size_bytes()); };
  if (Status s = resampleSliceByRows(volume, plane, use, cancel); !s) return s;
  return out->commit();
}

Status writeSlice(const SlicePlane& plane, const Opened& opened, const SliceOptions& options,
                  const Asked& asked, const CancelToken& cancel) {
  if (Status s = checkPlane(plane); !s) return s;  // checks before memory for its pixels is taken
  const Volume& volume = *opened.loaded.drawn;
  if (isFloatPicture(options.output)) return writeValues(volume, plane, options.output, cancel);
  const GreyMapping grey = windowGrey(volume, opened.series.format == "DICOM",
                                      asked.window ? *asked.window : firstWindow(volume, opened.series.unit));
  const PictureText text{{"Software", "volumen " VOLUMEN_VERSION},
                         {"Comment", "Not for clinical use"},
                         {"volumen-plane", planeJson(plane).dump()},
                         {"volumen-window", windowText(grey)}};
  Result<QImage> image = greyImage(volume, plane, grey, cancel);
  if (!image) return image.error();
  return writePictureWithWarnings(*std::move(image), text, opened.loaded.warnings, !options.noWarningLine,
                                  options.output);
}

// Checks options that are invalid for any volume.
Status checkUsage(const SliceOptions& options, const Asked& asked) {
  if (options.output.empty() && !options.printPlane)
    return Error{"Missing output file: use -o PICTURE (.png or .nrrd)."};
  if (!options.output.empty())
    if (Status s = checkPictureName(options.output); !s) return s;
  if (options.plane == framePlane &&
      (asked.size || asked.centre || asked.rightAndDown || options.at || options.mmPerPixel ||
       options.slabMm > 0 || options.average || options.printPlane || options.interpolation != "linear"))
    return Error{
        "--plane frame shows a picture as acquired: only --index, --window, --series and --presentation go "
        "with it."};
  if (options.plane != framePlane && !options.presentation.empty())
    return Error{"--presentation is for pictures as acquired: use it with --plane frame."};
  SlicePlane plane;
  if (asked.size) plane.size = *asked.size;
  return checkPlane(plane);
}

int draw(const SliceOptions& options, const Asked& asked, const SlicePlane& plane, const Opened& opened,
         const CancelToken& cancel) {
  if (options.output.empty()) return exitDone;
  if (Status s = writeSlice(plane, opened, options, asked, cancel); !s) return fail(s.message(), cancel);
  // With --print-plane, stdout holds only the plane.
  (options.printPlane ? std::cerr : std::cout) << printable(options.output) << '\n';
  return exitDone;
}

int run(const SliceOptions& options, const CancelToken& cancel) {
  const auto asked = readOptions(options);
  if (!asked) return failUsage(asked.message());
  if (Status s = checkUsage(options, *asked); !s) return failUsage(s.message());
  if (!options.output.empty())
    if (auto file = OutputFile::create(options.output); !file) return fail(file.message());
  if (options.plane == framePlane)
    return sliceFrame({options.path, options.series, options.output, options.index, asked->window,
                       options.presentation, !options.noGraphics},
                      cancel);
  auto opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  if (options.index && opened->loaded.drawn != opened->loaded.acquired)
    opened->notes.push_back("--index counts the evenly spaced slices that are shown in 3D: " +
                            std::to_string(opened->loaded.drawn->size().z) + ".");
  printNotes(opened->notes);
  const auto plane = makePlane(options, *asked, opened->loaded.drawn->geometry());
  if (!plane) return fail(plane.message());
  if (const int failed = draw(options, *asked, *plane, *opened, cancel)) return failed;
  if (options.printPlane) std::cout << jsonText(planeJson(*plane));
  return opened->status();
}

// Adds the options for the position of the plane.
void addPlane(CLI::App& app, SliceOptions& o) {
  constexpr double farMm = 1e6;
  std::vector<std::string> names = keys(planes);
  names.emplace_back(framePlane);
  CLI::Option* plane =
      oneOf(app.add_option("--plane", o.plane, "The plane, or a picture as acquired: frame (default: axial)"),
            names);
  CLI::Option* at = number(app.add_option("--at", o.at,
                                          "Where the plane lies: z of an axial, y of a coronal, x of a "
                                          "sagittal one, in mm (default: the volume's centre)"),
                           -farMm, farMm);
  CLI::Option* index =
      wholeNumber(app.add_option("--index", o.index,
                                 "The N-th slice or frame, from 0; of a plane parallel to the slices"),
                  0, 1000000);
  CLI::Option* centre =
      app.add_option("--centre", o.centre, "The centre of the picture, in mm (default: the volume's)");
  CLI::Option* right =
      app.add_option("--right", o.right, "Where the right of the picture is, a direction in the patient");
  CLI::Option* down = app.add_option("--down", o.down, "Where the bottom of the picture is");
  for (CLI::Option* vector : {centre, right, down}) vector->type_name("X,Y,Z");
  right->needs(down)->excludes(plane)->excludes(at);
  down->needs(right);
  at->excludes(index)->excludes(centre);
  index->excludes(centre);
}

}  // namespace

std::function<int()> makeSlice(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<SliceOptions>();
  addPath(app, o->path)->required();
  addPictureOutput(app, o->output, "The picture: .png (8 bits) or .nrrd (floats, before the window)");
  addSeries(app, o->series);
  addPlane(app, *o);
  app.add_option("--size", o->size, "Picture size in pixels, WIDTHxHEIGHT (default: all of the volume)")
      ->type_name("WxH");
  number(app.add_option("--mm-per-pixel", o->mmPerPixel,
                        "Size of a pixel (default: the smallest voxel spacing)"),
         1e-6, 1e6);
  CLI::Option* slab =
      number(app.add_option("--slab", o->slabMm, "Thickness of a slab around the plane, in mm"), 0, 1e6);
  oneOf(app.add_option("--slab-mode", o->slabMode, "What of a slab is shown (default: max)"), keys(slabModes))
      ->needs(slab);
  oneOf(app.add_option("--interpolation", o->interpolation, "Between voxels (default: linear)"),
        keys(interpolations));
  app.add_flag("--average", o->average, "Average over pixels that are larger than voxels");
  app.add_option("--window", o->window,
                 "Centre and width of the values from black to white (default: the file's, else nearly all)")
      ->type_name("C,W");
  CLI::Option* presentation =
      app.add_option(
             "--presentation", o->presentation,
             "Show the frame as a grayscale presentation state has it: its file, or its number in info")
          ->type_name("FILE|NUMBER");
  app.add_flag("--no-graphics", o->noGraphics, "Leave out the graphics of the presentation state")
      ->needs(presentation);
  addNoWarningLine(app, o->noWarningLine);
  app.add_flag("--print-plane", o->printPlane, "Write the plane in use to stdout, as JSON");
  addExamples(app, {"volumen slice scans/ --plane coronal --slab 10 -o coronal.png",
                    "volumen slice scans/ --index 7 --window 40,400 -o slice.png"});
  return [o, &cancel] { return run(*o, cancel); };
}

}  // namespace volumen
