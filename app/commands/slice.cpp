#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command.h"
#include "app/commands/slice_frame.h"
#include "app/open_volume.h"
#include "app/output_names.h"
#include "app/picture_output.h"
#include "app/plane_options.h"
#include "app/slice_picture.h"
#include "app/usage.h"
#include "io/files/output_file.h"
#include "io/paths/open_path.h"
#include "viewer/slice/slice.h"

namespace volumen {

namespace {

// Options as typed.
struct SliceOptions {
  std::string path, series, output, window, presentation;
  PlaneOptions plane;
  OverlayOptions overlay;
  RelationOptions relation;
  bool printPlane = false, noWarningLine = false, noGraphics = false;
};

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

// Protects all files that are read.
Status checkApartFrom(const SliceOptions& options, std::vector<std::string> read) {
  if (options.output.empty()) return {};
  for (const std::string& path :
       {options.path, options.presentation, options.overlay.path, options.relation.session})
    read.push_back(path);
  return checkApart({&options.output, 1}, read);
}

Status writeSlice(const SlicePlane& plane, const Opened& opened, const SliceOptions& options,
                  const std::optional<Window>& window, const std::optional<Overlay>& overlay,
                  const CancelToken& cancel) {
  if (Status s = checkPlane(plane); !s) return s;  // checks before memory for its pixels is taken
  std::vector<std::string> read = opened.series.files;
  if (overlay)
    read.insert(read.end(), overlay->opened.series.files.begin(), overlay->opened.series.files.end());
  if (Status s = checkApartFrom(options, std::move(read)); !s) return s;
  if (isFloatPicture(options.output)) return writeValues(*opened.loaded.drawn, plane, options.output, cancel);
  auto picture = slicePicture(opened, plane, window, overlay, cancel);
  if (!picture) return picture.error();
  const PictureText text = sliceText(plane, *picture);
  return writePictureWithWarnings(std::move(picture->image), text, opened.loaded.warnings,
                                  !options.noWarningLine, options.output);
}

Status checkOverlay(const SliceOptions& options) {
  const bool relates = options.relation.registers || !options.relation.session.empty();
  if (!options.overlay.isGiven())
    return relates ? Error{"--register and --registration go with --overlay."} : Status();
  if (options.plane.plane == acquiredPlane)
    return Error{"--overlay is for planes through a volume, not for pictures as acquired."};
  if (isFloatPicture(options.output))
    return Error{"--overlay draws colours: name a picture that ends in .png."};
  const auto window = windowOf(options.overlay.window, "--overlay-window");
  return window ? Status() : Status(window.error());
}

// Checks options that are invalid for any volume.
Status checkUsage(const SliceOptions& options, const AskedPlane& asked) {
  if (options.output.empty() && !options.printPlane)
    return Error{"Missing output file: use -o PICTURE (.png or .nrrd)."};
  if (!options.output.empty())
    if (Status s = checkPictureName(options.output); !s) return s;
  const PlaneOptions& how = options.plane;
  if (how.plane == acquiredPlane &&
      (asked.size || asked.centre || asked.rightAndDown || how.at || how.mmPerPixel || how.slabMm > 0 ||
       how.average || options.printPlane || how.interpolation != "linear"))
    return Error{
        "--plane frame shows a picture as acquired: only --index, --window, --series and --presentation go "
        "with it."};
  if (how.plane != acquiredPlane && !options.presentation.empty())
    return Error{"--presentation is for pictures as acquired: use it with --plane frame."};
  if (Status s = checkOverlay(options); !s) return s;
  SlicePlane plane;
  if (asked.size) plane.size = *asked.size;
  return checkPlane(plane);
}

// Checks that the output can be written, before anything is read.
Status checkSliceOutput(const SliceOptions& options) {
  if (options.output.empty()) return {};
  if (Status s = checkApartFrom(options, {}); !s) return s;
  const auto file = OutputFile::create(options.output);
  return file ? Status() : Status(file.error());
}

int drawFrame(const SliceOptions& options, const std::optional<Window>& window, const CancelToken& cancel) {
  std::error_code ignored;
  if (std::filesystem::exists(options.output, ignored)) {
    const auto files = filesOfPath(options.path, {}, cancel);
    if (!files) return fail(files.message(), cancel);
    if (Status s = checkApartFrom(options, *files); !s) return fail(s.message());
  }
  return sliceFrame({options.path, options.series, options.output, options.plane.index, window,
                     options.presentation, !options.noGraphics},
                    cancel);
}

int run(const SliceOptions& options, const CancelToken& cancel) {
  const PlaneOptions& how = options.plane;
  const auto asked = readPlane(how);
  if (!asked) return failUsage(asked.message());
  const auto window = windowOf(options.window);
  if (!window) return failUsage(window.message());
  if (Status s = checkUsage(options, *asked); !s) return failUsage(s.message());
  if (Status s = checkSliceOutput(options); !s) return fail(s.message());
  if (how.plane == acquiredPlane) return drawFrame(options, *window, cancel);
  auto opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  noteEvenSlices(how, *opened);
  const auto overlay = openOverlay(options.overlay, options.relation, options.path, *opened, cancel);
  if (!overlay) return fail(overlay.message(), cancel);
  printNotes(opened->notes);
  const auto plane = makePlane(how, *asked, opened->loaded.drawn->geometry());
  if (!plane) return fail(plane.message());
  if (!options.output.empty()) {
    if (Status s = writeSlice(*plane, *opened, options, *window, *overlay, cancel); !s)
      return fail(s.message(), cancel);
    // With --print-plane, stdout holds only the plane.
    (options.printPlane ? std::cerr : std::cout) << printable(options.output) << '\n';
  }
  if (options.printPlane) std::cout << jsonText(planeJson(*plane));
  return opened->status();
}

}  // namespace

std::function<int()> makeSlice(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<SliceOptions>();
  addPath(app, o->path)->required();
  addPictureOutput(app, o->output, "The picture: .png (8 bits) or .nrrd (floats, before the window)");
  addSeries(app, o->series);
  addPlaneOptions(app, o->plane, true);
  app.add_option("--size", o->plane.size, "Picture size in pixels, WIDTHxHEIGHT (default: all of the volume)")
      ->type_name("WxH");
  addWindow(app, o->window);
  addOverlayOptions(app, o->overlay);
  addRelationOptions(app, o->relation);
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
