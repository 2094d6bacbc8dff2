#include "app/exports/export_formats.h"

#include <algorithm>
#include <string_view>

#include "app/usage.h"

namespace volumen {

namespace {

bool has(const std::vector<const char*>& options, std::string_view name) {
  return std::ranges::find(options, name) != options.end();
}

using Options = std::vector<const char*>;

const Options planeOptions = {"--plane",  "--at",   "--index",     "--centre",       "--right",
                              "--down",   "--slab", "--slab-mode", "--mm-per-pixel", "--interpolation",
                              "--average"};
const Options relationOptions = {"--register", "--registration"};
const Options overlayOptions = {"--overlay", "--overlay-series", "--overlay-window", "--overlay-colours",
                                "--overlay-opacity"};
const Options sceneOptions = {"--scene",      "--preset",  "--view",      "--mode",
                              "--projection", "--quality", "--turntable", "--remove-table"};

Options joined(Options all, const Options& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

bool isGiven(const CLI::App& app, const char* name) {
  const auto& words = app.get_option(name)->results();
  return !words.empty() && !words.front().empty();
}

const Options captureOptions = joined({"--frame-ms"}, sceneOptions);

// Returns an Error if one of the options is given. `why` completes its sentence.
Status checkNone(const CLI::App& app, const Options& options, const char* why) {
  const auto found = std::ranges::find_if(options, [&](const char* name) { return isGiven(app, name); });
  return found == options.end() ? Status() : Status(Error{std::string(*found) + why});
}

}  // namespace

std::span<const ExportFormat> exportFormats() {
  static const Options ofOther = joined(overlayOptions, relationOptions);
  static const Options ofSeries =
      joined(joined({"--series", "--size", "--spacing", "--window", "--onto", "--onto-series",
                     "--remove-table", "--segments", "--without-segments", "--roi"},
                    planeOptions),
             ofOther);
  static const Options ofPictures = joined({"--series", "--size", "--window"}, planeOptions);
  static const Options ofCapture = joined(joined({"--rle"}, ofPictures), joined(captureOptions, ofOther));
  static const Options ofFilm =
      joined(joined({"--fps", "--spacing", "--time-points"}, ofPictures), sceneOptions);
  static const ExportFormat formats[] = {
      {"sr",
       "measurements and numbers of segments as a DICOM structured report (TID 1500)",
       {},
       {"--roi", "--segments", "--series"},
       exportReport,
       checkReport},
      {"ko",
       "key images as a DICOM key object selection",
       {"--images"},
       {"--title"},
       exportKeyObjects,
       checkKeyObjects},
      {"gsps",
       "windows and measurements of grey images as a DICOM presentation state",
       {},
       {"--window", "--roi", "--images", "--series"},
       exportPresentation,
       checkPresentation},
      {"seg", "segments as a DICOM segmentation", {"--segments"}, {"--series"}, exportSegmentation},
      {"rtstruct", "segments as an RT Structure Set", {"--segments"}, {"--series"}, exportStructureSet},
      {"series",
       "slices along a plane, fused with an overlay, or across a curve, or on the grid of another series, "
       "or with parts taken away, as a DICOM series, into a folder",
       {},
       ofSeries,
       exportSeries,
       checkSeries},
      {"stl",
       "surfaces of segments, a file each",
       {"--segments"},
       {"--series"},
       exportSegmentSurfaces,
       nullptr,
       false},
      {"sc",
       "a rendering, a turn of it or a slice as a DICOM Secondary Capture",
       {},
       ofCapture,
       exportCapture,
       checkCapture},
      {"apng",
       "a turn, slices, time points or a clip as an animated PNG",
       {},
       ofFilm,
       exportFilm,
       checkAnimatedPng,
       false},
      {"mp4", "the same as MP4, if the program ffmpeg is installed", {}, ofFilm, exportFilm, checkMp4, false},
      {"pdf",
       "a PDF file as a DICOM document of the study",
       {"--pdf"},
       {"--title", "--series"},
       exportPdf,
       nullptr,
       true,
       true}};
  return formats;
}

Status checkFormatOptions(const CLI::App& app, const ExportFormat* format) {
  for (const ExportFormat& other : exportFormats())
    for (const auto& options : {other.needs, other.takes})
      for (const char* option : options) {
        if (!isGiven(app, option)) continue;
        if (!format) return Error{std::string(option) + " goes with --as."};
        if (!has(format->needs, option) && !has(format->takes, option))
          return Error{std::string(option) + " does not go with --as " + format->name + "."};
      }
  if (!format) return {};
  for (const char* option : format->needs)
    if (!isGiven(app, option)) {
      const std::string value = app.get_option(option)->get_type_name();
      return Error{std::string("--as ") + format->name + " needs " + option + " " + value + "."};
    }
  return {};
}

Status checkOther(const CLI::App& app, const ExportJob& job) {
  const auto refused = [&](const Options& options, const char* why) { return checkNone(app, options, why); };
  if (!job.isOnto() && !job.overlay.isGiven()) {
    if (Status s = refused(overlayOptions, " goes with --overlay."); !s) return s;
    return refused(relationOptions, " goes with --onto or --overlay.");
  }
  if (!job.isOnto()) return {};
  if (Status s = refused(overlayOptions, " does not go with --onto: fuse along a plane."); !s) return s;
  Options placing = joined({"--size", "--spacing", "--window"}, planeOptions);
  std::erase(placing, std::string_view("--interpolation"));
  return refused(placing, " does not go with --onto: the other series says where the slices lie.");
}

Status checkCurve(const CLI::App& app, const ExportFormat& format) {
  if (!isGiven(app, "--roi") || !has(format.takes, "--spacing")) return {};
  return checkNone(app,
                   {"--plane", "--at", "--index", "--centre", "--right", "--down", "--onto", "--onto-series",
                    "--overlay", "--overlay-series"},
                   " does not go with --roi: slices lie across its curve.");
}

Status settlePlane(const CLI::App& app, const ExportFormat& format, ExportJob& job) {
  const auto given = [&](const char* option) { return isGiven(app, option); };
  if (given("--size")) job.plane.size = job.scene.size;
  job.hasPlane = std::ranges::any_of(planeOptions, given);
  if (job.isOfFrames() && !has(format.takes, "--fps"))
    return Error{std::string("--plane frame is for films and `volumen slice`, not for --as ") + format.name +
                 "."};
  if (!job.hasPlane || !has(format.takes, "--scene")) return {};
  const auto ofScene = std::ranges::find_if(captureOptions, given);
  if (ofScene == captureOptions.end()) return {};
  return Error{std::string(*ofScene) + " is for 3D pictures: leave it or the options of the plane out."};
}

void addFormatOptions(CLI::App& app, ExportJob& job) {
  app.add_option(
         "--roi", job.shapes,
         "Of sr and gsps: the shapes to measure, as for `volumen measure`; of series: the curve (openCurve) "
         "that slices lie across")
      ->type_name("FILE");
  app.add_option(
         "--images", job.images,
         "Of ko and gsps: the images, UID,... by SOPInstanceUID, or UID/FRAME of one with several frames, "
         "which count from 1 (default of gsps: all of the series)")
      ->type_name("LIST");
  app.add_option(
         "--title", job.title,
         "Of ko: the reason for the choice, a code of CID 7010 (default: 113000, Of Interest); of pdf: "
         "the title of the document")
      ->type_name("TITLE");
  app.add_option("--segments", job.segments,
                 "Of seg, rtstruct, stl: a file of segments, as for `volumen measure`; of sr: a DICOM "
                 "segmentation whose "
                 "numbers to report; of series: all outside of these segments becomes air")
      ->type_name("FILE");
  app.add_flag("--without-segments", job.withoutSegments,
               "Of series: what lies in the segments becomes air, all else stays")
      ->needs("--segments");
  app.add_option("--pdf", job.pdf, "Of pdf: the PDF file")->type_name("FILE");
  addSeries(app, job.series);
  app.add_flag("--remove-table", job.removeTable,
               "Of sc and films in 3D: CT: draw the patient alone, without table, cushions and cables; of "
               "series: these become air");
  addSceneOptions(app, job.scene);
  app.get_option("--size")->description(
      "Picture size in pixels, WIDTHxHEIGHT (default: 512x512 in 3D, all of the volume for slices)");
  addQuality(app, job.method);
  wholeNumber(app.add_option("--turntable", job.turntable,
                             "Of sc and films: N pictures of a full turn (default of films: 36)"),
              1, 9999);
  number(
      app.add_option("--frame-ms", job.frameMs, "Of sc: the time of each picture of a turn (default: 100)"),
      1, 60000);
  wholeNumber(app.add_option("--fps", job.framesPerSecond,
                             "Of films: pictures a second (default: those of a clip, else 10)"),
              1, mostPerSecond);
  app.add_flag("--time-points", job.timePoints,
               "Of films: a slice or, without a plane, the 3D picture in each time point of the series");
  app.add_flag("--rle", job.rle, "Of sc: compress without loss (RLE)");
  addPlaneOptions(app, job.plane, true);
  addWindow(app, job.window);
  number(app.add_option(
             "--spacing", job.spacingMm,
             "Of series and films: from slice to slice, in mm (default: the thickness of the slab, else the "
             "volume's spacing)"),
         1e-3, 1e6);
  app.add_option("--onto", job.onto,
                 "Of series: resample on the grid of this series, in its frame of reference (default with "
                 "--onto-series: PATH)")
      ->type_name("OTHER");
  app.add_option("--onto-series", job.ontoSeries, "The series of OTHER, as --series")->type_name("SERIES");
  addOverlayOptions(app, job.overlay);
  addRelationOptions(app, job.relation);
}

}  // namespace volumen
