#include <QTemporaryDir>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/exports/export_formats.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/send_files.h"
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
  if (std::filesystem::is_regular_file(source, ignored))
    return std::filesystem::equivalent(folder, std::filesystem::canonical(source, ignored).parent_path(),
                                       ignored);
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

Json toJson(const DeidentifyReport& report) {
  return {{"written", report.written},
          {"alreadyThere", report.alreadyThere},
          {"twice", report.twice},
          {"notDicom", report.notDicom},
          {"leftOut", listOf(report.leftOut)},
          {"withText", report.withText},
          {"withFaces", report.withFaces},
          {"withoutSuv", report.withoutSuv},
          {"withoutMosaic", report.withoutMosaic},
          {"faceless", report.faceless}};
}

void print(const DeidentifyReport& report, const std::string& folder, bool json) {
  if (json) {
    Json all{{"folder", pathForJson(folder)}};
    all.update(toJson(report));
    std::cout << jsonText(all);
    return;
  }
  std::cout << "Wrote " << report.written << " files without identity";
  if (report.alreadyThere > 0) std::cout << "; " << report.alreadyThere << " were there already";
  if (report.twice > 0) std::cout << "; " << report.twice << " are copies of others";
  if (report.notDicom > 0) std::cout << "; " << report.notDicom << " files are no DICOM";
  std::cout << ": " << folder << '\n';
}

void warn(const DeidentifyReport& report) {
  for (const Refused& one : report.leftOut)
    std::cerr << "volumen: " << one.path << " is left out: " << one.reason << ".\n";
  noteSeries(report.withText, "Names may be burned into the pixels, look at them");
  noteSeries(report.faceless, "The face was taken away in pictures of a head, look at a rendering");
  noteSeries(report.withFaces, "A face may be recognised in pictures of a head");
  noteSeries(report.withoutSuv,
             "SUV cannot be computed any more (--keep patient,dates keeps what it needs, or --shift-dates)");
  noteSeries(report.withoutMosaic,
             "The slices of a Siemens mosaic form no volume any more, as their private header is gone");
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

// Puts the names that the user gave in place of those of temporary files.
struct GivenNames {
  const OutputTarget& target;
  std::string made{}, given{};  // what was made of `given`, if it is no copy of files

  std::string in(std::string text) const {
    text = target.told(std::move(text));
    return made.empty() ? text : replaced(std::move(text), made, given);
  }
};

void nameAsGiven(std::vector<std::string>& texts, const GivenNames& names) {
  for (std::string& one : texts) one = names.in(std::move(one));
}

void nameAsGiven(DeidentifyReport& report, const GivenNames& names) {
  for (Refused& one : report.leftOut) {
    const bool isMade = !names.made.empty() && one.path.starts_with(names.made);
    one = {isMade ? names.given : names.in(one.path), names.in(one.reason)};
  }
  for (auto* series :
       {&report.withText, &report.withFaces, &report.withoutSuv, &report.withoutMosaic, &report.faceless})
    nameAsGiven(*series, names);
}

// Sends what was written for an archive. `written` is what the JSON says of it; `status`, how writing ended.
int sendWritten(const OutputTarget& target, Json written, bool json, int status, const CancelToken& cancel) {
  const auto files = filesOfPath(target.path(), {}, cancel);
  if (!files) return fail(target.told(files.message()), cancel);
  auto report = sendFiles(*target.archive(), *files, cancel);
  if (!report) return fail(target.told(report.message()));
  for (auto* list : {&report->failed, &report->notDicom})
    for (Refused& one : *list) one.path = target.told(one.path);
  written["archive"] = {{"name", target.archive()->name}};
  written["archive"].update(sentJson(*report));
  std::cout << (json ? jsonText(written) : sentText(*report, *target.archive()));
  const int sent = tellSent(*report, cancel);
  return sent == exitDone ? status : sent;
}

int writeFormat(const ExportFormat& format, const ExportOptions& options, const CancelToken& cancel) {
  const auto target = OutputTarget::of(options.job.output);
  if (!target) return fail(target.message());
  if (target->archive() && !format.isDicom)
    return failUsage(std::string("--as ") + format.name +
                     " writes no DICOM, which archives take: name a file.");
  ExportJob job = options.job;
  job.output = target->path();
  Result<Exported> done = format.write(job, cancel);
  if (!done) return fail(target->told(done.message()), cancel);
  nameAsGiven(done->notes, {*target});
  printNotes(done->notes);
  const int status = statusWith(done->unread);
  if (target->archive()) return sendWritten(*target, {{"notes", done->notes}}, options.json, status, cancel);
  print(done->files.empty() ? std::vector{job.output} : done->files, done->notes, options.json);
  return status;
}

Result<Deidentification> deidentificationOf(const ExportOptions& options) {
  Deidentification how{options.retained, {}, options.job.deface};
  for (const Kept& one : keepable)
    how.retained.*one.member = std::ranges::find(options.kept, one.name) != options.kept.end();
  const auto key = options.keyFile.empty() ? userPseudonymKey() : pseudonymKeyIn(options.keyFile);
  if (!key) return key.error();
  how.key = *key;
  return how;
}

// Writes copies without identity of the files of the job's path, or of `made` of it.
int deidentifyTo(const OutputTarget& target, const ExportOptions& options, const std::string& made,
                 const CancelToken& cancel) {
  const ExportJob& job = options.job;
  const auto how = deidentificationOf(options);
  if (!how) return fail(how.message());
  const GivenNames names{target, made, job.path};
  const auto files = filesOfPath(made.empty() ? job.path : made, terminalProgress(), cancel);
  if (!files) return fail(names.in(files.message()), cancel);
  int complete = 0;
  auto report = deidentifyFiles(*files, target.path(), *how, terminalProgress(), cancel, &complete);
  endTerminalProgress();
  if (!report && complete > 0 && !target.archive())
    return fail((cancel.cancelled() ? "Interrupted." : names.in(report.message())) + " Copies of " +
                std::to_string(complete) + " of " + std::to_string(files->size()) + " files are in " +
                job.output + ", each of them whole.");
  if (!report) return fail(names.in(report.message()), cancel);
  const int done = report->written + report->alreadyThere;
  if (done == 0 && report->leftOut.empty()) return fail(job.path + " holds no DICOM files.");
  nameAsGiven(*report, names);
  warn(*report);
  const int status = done == 0 ? exitFailed : report->leftOut.empty() ? exitDone : exitLosses;
  if (target.archive() && done > 0) return sendWritten(target, toJson(*report), options.json, status, cancel);
  print(*report, job.output, options.json);
  return status;
}

int deidentify(const ExportOptions& options, const CancelToken& cancel) {
  const auto target = OutputTarget::of(options.job.output);
  return target ? deidentifyTo(*target, options, {}, cancel) : fail(target.message());
}

// Writes the format into a temporary folder, and copies of that without identity.
int writeWithoutIdentity(const ExportFormat& format, const ExportOptions& options,
                         const CancelToken& cancel) {
  if (!format.isDicom)
    return failUsage(std::string("--as ") + format.name + " writes no DICOM: leave --deidentify out.");
  if (format.hasPages)
    return failUsage(std::string("--as ") + format.name +
                     " writes pages, which may name the patient: leave --deidentify out.");
  const auto target = OutputTarget::of(options.job.output);
  if (!target) return fail(target.message());
  const QTemporaryDir folder;
  if (!folder.isValid()) return fail("Cannot make a temporary folder: free some space.");
  const std::string made = folder.path().toStdString();
  const std::string& output = options.job.output;
  ExportJob job = options.job;
  job.output = made + "/made.dcm";  // a folder, if the format is a series
  const auto asGiven = [&](const std::string& text) {
    return replaced(replaced(text, job.output, output), made, output);
  };
  const Result<Exported> done = format.write(job, cancel);
  if (!done) return fail(asGiven(done.message()), cancel);
  std::vector<std::string> notes = done->notes;
  std::ranges::transform(notes, notes.begin(), asGiven);
  printNotes(notes);
  const int status = deidentifyTo(*target, options, made, cancel);
  return status == exitDone ? statusWith(done->unread) : status;
}

// The Error (wrong usage): --deface does not fit.
Status checkDeface(const ExportOptions& options) {
  if (!options.job.deface) return {};
  if (options.deidentifies != options.format.empty() || !(options.deidentifies || options.format == "series"))
    return Error{"--deface goes with --as series, or with --deidentify alone."};
  const bool keepsUids = std::ranges::find(options.kept, "uids") != options.kept.end();
  if (keepsUids) return Error{"--deface makes other pictures, which need other UIDs: leave \"uids\" out."};
  return {};
}

// The Error (wrong usage): options of --deidentify do not fit.
Status checkIdentity(const ExportOptions& options) {
  const ExportJob& job = options.job;
  if (!options.deidentifies) {
    if (options.kept.empty() && options.retained.shiftDays == 0 && options.keyFile.empty()) return {};
    return Error{"--keep, --shift-dates and --key go with --deidentify."};
  }
  if (isWithin(job.output, job.path))
    return Error{job.output + " is among the originals of " + job.path + ": name another folder."};
  const bool keepsDates = std::ranges::find(options.kept, "dates") != options.kept.end();
  if (keepsDates && options.retained.shiftDays != 0)
    return Error{"Dates are kept or shifted, not both: leave out \"dates\" or --shift-dates."};
  return {};
}

int run(const CLI::App& app, ExportOptions& options, const CancelToken& cancel) {
  if (options.format.empty() && !options.deidentifies)
    return failUsage("Say what leaves: --as FORMAT, --deidentify or both.");
  if (options.job.output.empty()) return failUsage("-o is empty: name the file or folder to write.");
  if (Status s = checkIdentity(options); !s) return failUsage(s.message());
  if (Status s = checkDeface(options); !s) return failUsage(s.message());
  const auto formats = exportFormats();
  const auto format = std::ranges::find(formats, options.format, &ExportFormat::name);
  const bool isKnown = format != formats.end();
  if (Status s = checkFormatOptions(app, isKnown ? &*format : nullptr); !s) return failUsage(s.message());
  if (!isKnown) return deidentify(options, cancel);
  if (Status s = checkOther(app, options.job); !s) return failUsage(s.message());
  if (Status s = checkCurve(app, *format); !s) return failUsage(s.message());
  if (Status s = settlePlane(app, *format, options.job); !s) return failUsage(s.message());
  if (format->check)
    if (Status s = format->check(options.job); !s) return failUsage(s.message());
  return options.deidentifies ? writeWithoutIdentity(*format, options, cancel)
                              : writeFormat(*format, options, cancel);
}

}  // namespace

std::function<int()> makeExport(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ExportOptions>();
  ExportJob& job = options->job;
  addPath(app, job.path)->required();
  app.add_option(
         "-o,--output", job.output,
         "The file to write (--as), or the folder (--as series, --deidentify); files that are there stay. "
         "Or archive:NAME: what is written is sent there, and kept nowhere else")
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
  app.add_flag("--deface", job.deface,
               "Take the face of heads of CT and MR away, air in its place and in front of it: with --as "
               "series of the slices as they are, with --deidentify of the copies of all heads");
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
