#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/exports/export_formats.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/usage.h"
#include "io/deidentify/deidentify_files.h"
#include "io/deidentify/pseudonyms.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct ExportOptions {
  ExportJob job;
  std::string format, keyFile;
  std::vector<std::string> kept;
  Retained retained;
  bool deidentifies = false, json = false;
};

struct Kept {
  const char* name;
  bool Retained::*member;
};

constexpr Kept keepable[] = {{"uids", &Retained::uids},       {"dates", &Retained::dates},
                             {"device", &Retained::device},   {"institution", &Retained::institution},
                             {"patient", &Retained::patient}, {"descriptors", &Retained::descriptors},
                             {"private", &Retained::privates}};

// A second run would take the copies for sources.
bool isWithin(const std::string& folder, const std::string& source) {
  std::error_code ignored;
  const auto inner = std::filesystem::weakly_canonical(folder, ignored).string() + "/";
  const auto outer = std::filesystem::weakly_canonical(source, ignored).string() + "/";
  return std::filesystem::is_directory(source, ignored) && inner.starts_with(outer);
}

Json listOf(const std::vector<Refused>& files) {
  Json list = Json::array();
  for (const Refused& one : files) list.push_back({{"path", pathForJson(one.path)}, {"reason", one.reason}});
  return list;
}

void noteSeries(const std::vector<std::string>& series, const char* what) {
  constexpr std::size_t most = 3;
  if (series.empty()) return;
  std::cerr << "volumen: " << what << ": ";
  for (std::size_t n = 0; n < std::min(most, series.size()); ++n) std::cerr << (n ? ", " : "") << series[n];
  if (series.size() > most) std::cerr << " and " << series.size() - most << " more";
  std::cerr << ".\n";
}

void print(const DeidentifyReport& report, const ExportOptions& options) {
  if (options.json) {
    std::cout << jsonText({{"folder", pathForJson(options.job.output)},
                           {"written", report.written},
                           {"alreadyThere", report.alreadyThere},
                           {"twice", report.twice},
                           {"notDicom", report.notDicom},
                           {"leftOut", listOf(report.leftOut)},
                           {"withText", report.withText},
                           {"withFaces", report.withFaces},
                           {"withoutSuv", report.withoutSuv}});
  } else {
    std::cout << "Wrote " << report.written << " files without identity";
    if (report.alreadyThere > 0) std::cout << "; " << report.alreadyThere << " were there already";
    if (report.twice > 0) std::cout << "; " << report.twice << " are copies of others";
    if (report.notDicom > 0) std::cout << "; " << report.notDicom << " files are no DICOM";
    std::cout << ": " << options.job.output << '\n';
  }
  for (const Refused& one : report.leftOut)
    std::cerr << "volumen: " << one.path << " is left out: " << one.reason << ".\n";
  noteSeries(report.withText, "Names may be burned into the pixels, look at them");
  noteSeries(report.withFaces, "A face may be recognised in pictures of a head");
  noteSeries(report.withoutSuv,
             "SUV cannot be computed any more (--keep patient,dates keeps what it needs, or --shift-dates)");
}

void print(const std::vector<std::string>& files, const std::vector<std::string>& notes, bool json) {
  if (!json) {
    for (const std::string& file : files) std::cout << "Wrote " << printable(file) << ".\n";
    return;
  }
  Json list = Json::array();
  for (const std::string& file : files) list.push_back(pathForJson(file));
  std::cout << jsonText({{"file", list.front()}, {"files", list}, {"notes", notes}});
}

int writeFormat(const ExportFormat& format, const ExportOptions& options, const CancelToken& cancel) {
  const ExportJob& job = options.job;
  if (!options.kept.empty() || options.retained.shiftDays != 0 || !options.keyFile.empty())
    return failUsage("--keep, --shift-dates and --key go with --deidentify.");
  const Result<Exported> done = format.write(job, cancel);
  if (!done) return fail(done.message(), cancel);
  printNotes(done->notes);
  print(done->files.empty() ? std::vector{job.output} : done->files, done->notes, options.json);
  return statusWith(done->unread);
}

int deidentify(const ExportOptions& options, const CancelToken& cancel) {
  const ExportJob& job = options.job;
  if (isWithin(job.output, job.path))
    return failUsage(job.output + " lies within " + job.path + ": name another folder.");
  Deidentification how{options.retained, {}};
  for (const Kept& one : keepable)
    how.retained.*one.member = std::ranges::find(options.kept, one.name) != options.kept.end();
  if (how.retained.dates && how.retained.shiftDays != 0)
    return failUsage("Dates are kept or shifted, not both: leave out \"dates\" or --shift-dates.");
  const auto key = options.keyFile.empty() ? userPseudonymKey() : pseudonymKeyIn(options.keyFile);
  if (!key) return fail(key.message());
  how.key = *key;
  const auto files = filesOfPath(job.path, terminalProgress(), cancel);
  if (!files) return fail(files.message(), cancel);
  const auto report = deidentifyFiles(*files, job.output, how, terminalProgress(), cancel);
  endTerminalProgress();
  if (!report) return fail(report.message(), cancel);
  const int done = report->written + report->alreadyThere;
  if (done == 0 && report->leftOut.empty()) return fail(job.path + " holds no DICOM files.");
  print(*report, options);
  return done == 0 ? exitFailed : report->leftOut.empty() ? exitDone : exitLosses;
}

int run(const CLI::App& app, ExportOptions& options, const CancelToken& cancel) {
  if (options.format.empty() != options.deidentifies)
    return failUsage("Say what leaves: either --as FORMAT or --deidentify.");
  const auto formats = exportFormats();
  const auto format = std::ranges::find(formats, options.format, &ExportFormat::name);
  const bool isKnown = format != formats.end();
  if (Status s = checkFormatOptions(app, isKnown ? &*format : nullptr); !s) return failUsage(s.message());
  if (!isKnown) return deidentify(options, cancel);
  if (Status s = settlePlane(app, options.job); !s) return failUsage(s.message());
  if (format->check)
    if (Status s = format->check(options.job); !s) return failUsage(s.message());
  return writeFormat(*format, options, cancel);
}

}  // namespace

std::function<int()> makeExport(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ExportOptions>();
  ExportJob& job = options->job;
  addPath(app, job.path)->required();
  app.add_option("-o,--output", job.output,
                 "The file to write (--as), or the folder (--deidentify); files that are there stay")
      ->type_name("FILE")
      ->required();
  std::vector<std::string> formats;
  std::string texts;
  for (const ExportFormat& format : exportFormats()) {
    formats.emplace_back(format.name);
    texts += (texts.empty() ? "" : "; ") + std::string(format.name) + ": " + format.text;
  }
  oneOf(app.add_option("--as", options->format, "Write this format. " + texts), formats);
  addFormatOptions(app, job);
  app.add_flag("--deidentify", options->deidentifies,
               "Remove the patient's identity (PS3.15 E, Basic Application Level Confidentiality Profile)");
  std::vector<std::string> names;
  for (const Kept& one : keepable) names.emplace_back(one.name);
  app.add_option(
         "--keep", options->kept,
         "What stays all the same, separated by commas: uids, dates, device, institution, patient (sex, "
         "age, size, weight), descriptors (known words only), private (elements that are known to be safe)")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(CLI::IsMember(names).description(""));
  wholeNumber(app.add_option("--shift-dates", options->retained.shiftDays,
                             "Keep dates, moved by this number of days"),
              -36500, 36500);
  app.add_option(
         "--key", options->keyFile,
         "The file with the secret that new UIDs and names follow from (default: deidentification.key in "
         "~/.config/volumen, made at first)")
      ->type_name("FILE");
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen export scans/ --as sr --roi shapes.json -o report.dcm",
                    "volumen export scans/ --deidentify -o teaching/"});
  return [&app, options, &cancel] { return run(app, *options, cancel); };
}

}  // namespace volumen
