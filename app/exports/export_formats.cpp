#include "app/exports/export_formats.h"

#include <algorithm>
#include <string_view>

#include "app/usage.h"

namespace volumen {

namespace {

bool has(const std::vector<const char*>& options, std::string_view name) {
  return std::ranges::find(options, name) != options.end();
}

bool isGiven(const CLI::App& app, const char* name) {
  const auto& words = app.get_option(name)->results();
  return !words.empty() && !words.front().empty();
}

}  // namespace

std::span<const ExportFormat> exportFormats() {
  static const ExportFormat formats[] = {
      {"sr", "measurements as a DICOM structured report (TID 1500)", {"--roi"}, {"--series"}, exportReport},
      {"ko", "key images as a DICOM key object selection", {"--images"}, {"--title"}, exportKeyObjects},
      {"rtstruct", "segments as an RT Structure Set", {"--segments"}, {"--series"}, exportStructureSet}};
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

void addFormatOptions(CLI::App& app, ExportJob& job) {
  app.add_option("--roi", job.shapes, "Of sr: the shapes to measure, as for `volumen measure`")
      ->type_name("FILE");
  app.add_option("--images", job.images,
                 "Of ko: the key images, UID,... by SOPInstanceUID, or UID/FRAME of one with several frames, "
                 "which count from 1")
      ->type_name("LIST");
  app.add_option("--title", job.title,
                 "Of ko: the reason for the choice, a code of CID 7010 (default: 113000, Of Interest)")
      ->type_name("CODE");
  app.add_option("--segments", job.segments, "Of rtstruct: a file of segments, as for `volumen measure`")
      ->type_name("FILE");
  addSeries(app, job.series);
}

}  // namespace volumen
