#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands/archive_receive.h"
#include "app/progress.h"
#include "app/send_files.h"
#include "app/study_lines.h"
#include "app/usage.h"
#include "app/index_option.h"
#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/archive/search_archive.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct ArchiveOptions {
  std::string file, name;
  std::vector<std::string> words;
  ArchiveQuery query;
  std::string study, folder, index;
  bool json = false, isLetGo = false;

  std::string path() const { return file.empty() ? userArchivesFile() : file; }
};

Result<Archives> archivesOf(const ArchiveOptions& options) {
  std::error_code ignored;
  if (!options.file.empty() && !std::filesystem::exists(options.file, ignored))
    return Error{options.file + " cannot be read: no such file."};
  return readArchives(options.path());
}

Result<Archive> chosen(const ArchiveOptions& options) {
  const auto all = archivesOf(options);
  return all ? archiveNamed(*all, options.name, options.path()) : all.error();
}

// A script that reads only the JSON must see a failure, too: with `nothing`, what it reads of an empty
// result.
int failed(const ArchiveOptions& options, Json nothing, const std::string& sentence) {
  if (options.json) {
    nothing["problem"] = sentence;
    std::cout << jsonText(nothing);
  }
  return fail(sentence);
}

int list(const ArchiveOptions& options) {
  const auto all = archivesOf(options);
  if (!all) return failed(options, {{"archives", Json::array()}}, all.message());
  if (options.json) {
    std::cout << archivesToJson(*all);
  } else if (all->archives.empty()) {
    std::cerr << noArchives(options.path()) << '\n';
  } else {
    TextTable table({"Name", "Address", "Its AE title", "Ours"});
    for (const Archive& a : all->archives)
      a.kind == ArchiveKind::dimse
          ? table.add({printable(a.name), printable(addressOf(a)) + (a.tls ? ", TLS" : ""), a.calledAe,
                       a.callingAe})
          : table.add({printable(a.name), printable(addressOf(a)), "", ""});
    std::cout << table.text();
  }
  return exitDone;
}

int test(const ArchiveOptions& options, const CancelToken& cancel) {
  const auto archive = chosen(options);
  if (!archive) return fail(archive.message());
  if (Status s = testArchive(*archive, cancel); !s) return fail(s.message(), cancel);
  std::cout << "The archive \"" << archive->name << "\" (" << addressOf(*archive) << ") answers.\n";
  return exitDone;
}

Json toJson(const ArchiveStudy& study, bool withSeries) {
  Json out = studyJson(study.study);
  if (!withSeries) return out;
  out["series"] = Json::array();
  for (const IndexedSeries& series : study.series) out["series"].push_back(seriesJson(series));
  return out;
}

// A study whose series the archive does not tell has a line, too.
IndexedSeries unknownSeries() {
  IndexedSeries series;
  series.images = series.frames = -1;
  return series;
}

void print(const ArchiveAnswers& answers, const ArchiveOptions& options) {
  const bool withSeries = options.query.withSeries;
  if (options.json) {
    Json studies = Json::array();
    for (const ArchiveStudy& study : answers.studies) studies.push_back(toJson(study, withSeries));
    Json out{{"studies", studies}};
    if (!answers.incomplete.empty()) out["incomplete"] = answers.incomplete;
    std::cout << jsonText(out);
  } else if (answers.studies.empty()) {
    if (answers.incomplete.empty()) std::cerr << "No study has all of these words.\n";
  } else {
    TextTable table = withSeries ? seriesTable() : studyTable();
    for (const ArchiveStudy& study : answers.studies) {
      if (!withSeries) addTo(table, study.study);
      if (withSeries && study.series.empty()) addTo(table, study.study, unknownSeries());
      for (const IndexedSeries& series : study.series) addTo(table, study.study, series);
    }
    std::cout << table.text();
  }
  if (!answers.incomplete.empty()) std::cerr << "volumen: " << printable(answers.incomplete) << '\n';
}

int query(const ArchiveOptions& options, const CancelToken& cancel) {
  const Json nothing{{"studies", Json::array()}};
  const auto archive = chosen(options);
  if (!archive) return failed(options, nothing, archive.message());
  ArchiveQuery asked = options.query;
  for (const std::string& word : options.words) asked.words += word + " ";
  const auto answers = searchArchive(*archive, asked, {}, cancel);
  if (!answers) return failed(options, nothing, cancel.cancelled() ? "Interrupted." : answers.message());
  print(*answers, options);
  return answers->isBroken ? exitLosses : exitDone;
}

// Puts fetched files into the index; a folder of the user's stays as it is. Returns the studies that were
// removed as too much.
Result<std::vector<std::string>> fileFetched(const FetchRequest& request, const Archive& archive,
                                             const std::string& indexFolder, const CancelToken& cancel) {
  if (!request.isManaged) return std::vector<std::string>();
  const auto imported = importIntoIndex(indexFolder, {request.folder}, terminalProgress(), cancel);
  endTerminalProgress();
  if (!imported) return imported.error();
  return trimFetched(indexFolder, mostBytesFetched(archive));
}

void print(const FetchReport& report, const std::vector<std::string>& removed, const std::string& folder,
           bool json) {
  if (json) {
    std::cout << jsonText({{"folder", pathForJson(folder)},
                           {"images", report.expected},
                           {"fetched", report.fetched},
                           {"alreadyHere", report.alreadyHere},
                           {"bytes", report.bytes},
                           {"missing", report.missing},
                           {"problems", report.problems},
                           {"removedStudies", removed}});
    return;
  }
  std::cout << "Fetched " << report.fetched << " of " << report.expected << " images";
  if (const int here = report.alreadyHere; here > 0)
    std::cout << "; " << here << (here == 1 ? " was" : " were") << " here already";
  std::cout << ": " << folder << '\n';
}

int fetch(const ArchiveOptions& options, const CancelToken& cancel) {
  const auto failedBecause = [&](const std::string& sentence) {
    return failed(options, {{"fetched", 0}},
                  cancel.cancelled()
                      ? "Interrupted; images that came whole are kept, and the next fetch goes on from there."
                      : sentence);
  };
  const auto archive = chosen(options);
  if (!archive) return failedBecause(archive.message());
  const std::string indexFolder = indexFolderOr(options.index);
  FetchRequest request = requestFor(options.study);
  request.isManaged = options.folder.empty();
  request.folder = request.isManaged ? fetchedFolder(indexFolder, request.studyUid) : options.folder;
  const auto report = fetchFromArchive(*archive, request, terminalProgress(), cancel);
  endTerminalProgress();
  if (!report) return failedBecause(report.message());
  const auto removed = fileFetched(request, *archive, indexFolder, cancel);
  if (!removed) return failedBecause(removed.message());
  print(*report, *removed, request.folder, options.json);
  if (const std::size_t count = removed->size(); count > 0 && !options.json)
    std::cout << "Removed " << count << (count == 1 ? " study that was" : " studies that were")
              << " fetched earlier, to keep at most " << archive->keepGb << " GB\n";
  for (const std::string& problem : report->problems) std::cerr << "volumen: " << printable(problem) << '\n';
  return report->isAll() ? exitDone : exitLosses;
}

int send(const ArchiveOptions& options, const CancelToken& cancel) {
  const auto failedBecause = [&](const std::string& sentence) {
    return failed(options, {{"sent", 0}}, sentence);
  };
  const auto archive = chosen(options);
  if (!archive) return failedBecause(archive.message());
  std::vector<std::string> files;
  for (const std::string& path : options.words) {
    const auto found = filesOfPath(path, terminalProgress(), cancel);
    if (!found) return failedBecause(cancel.cancelled() ? "Interrupted." : found.message());
    files.insert(files.end(), found->begin(), found->end());
  }
  const auto report = sendFiles(*archive, files, cancel);
  if (!report) return failedBecause(report.message());
  std::cout << (options.json ? jsonText(sentJson(*report)) : sentText(*report, *archive));
  return tellSent(*report, cancel);
}

int keep(const ArchiveOptions& options) {
  const std::string indexFolder = indexFolderOr(options.index);
  if (options.study.empty()) {
    const std::vector<std::string> kept = keptStudies(indexFolder);
    if (options.json) std::cout << jsonText({{"kept", kept}});
    if (kept.empty() && !options.json) std::cerr << "No study is kept.\n";
    for (const std::string& uid : options.json ? std::vector<std::string>() : kept)
      std::cout << printable(uid) << '\n';
    return exitDone;
  }
  const bool isKept = !options.isLetGo;
  if (Status s = keepFetched(indexFolder, options.study, isKept); !s)
    return failed(options, {{"study", options.study}}, s.message());
  if (options.json)
    std::cout << jsonText({{"study", options.study}, {"isKept", isKept}});
  else
    std::cout << "The study " << printable(options.study)
              << (isKept ? " is kept on this computer.\n"
                         : " is no longer kept: the size limit may remove it.\n");
  return exitDone;
}

// A nested command that asks no archive; `run` is what archive runs if it is chosen.
CLI::App* addLocal(CLI::App& app, const char* name, const char* text, const std::function<int()>& thisOne,
                   const std::shared_ptr<std::function<int()>>& run) {
  CLI::App* sub = app.add_subcommand(name, text);
  sub->group("Commands");
  sub->set_help_flag("-h,--help", "Show this help");
  sub->callback([=] { *run = thisOne; });
  return sub;
}

CLI::App* addNested(CLI::App& app, const char* name, const char* text, ArchiveOptions& options,
                    const std::function<int()>& thisOne, const std::shared_ptr<std::function<int()>>& run) {
  CLI::App* sub = addLocal(app, name, text, thisOne, run);
  sub->add_option("--archives", options.file,
                  "The file that lists the archives (default: archives.json in "
                  "~/.config/volumen)")
      ->type_name("FILE");
  return sub;
}

void addName(CLI::App& app, ArchiveOptions& options) {
  app.add_option("NAME", options.name, "The archive's name in `volumen archive list`")
      ->type_name("")
      ->required();
}

}  // namespace

std::function<int()> makeArchive(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<ArchiveOptions>();
  const auto run = std::make_shared<std::function<int()>>();
  app.require_subcommand(1);
  CLI::App* listed = addNested(
      app, "list", "List the archives", *o, [=] { return list(*o); }, run);
  listed->add_flag("--json", o->json, "Write the list as JSON to stdout");
  addExamples(*listed, {"volumen archive list", "volumen archive list --json"});

  CLI::App* tested = addNested(
      app, "test", "Say whether an archive answers", *o, [o, &cancel] { return test(*o, cancel); }, run);
  addName(*tested, *o);
  addExamples(*tested, {"volumen archive test main", "volumen archive test main --archives archives.json"});

  CLI::App* queried = addNested(
      app, "query", "Search the studies of an archive", *o, [o, &cancel] { return query(*o, cancel); }, run);
  addName(*queried, *o);
  queried
      ->add_option("WORDS", o->words,
                   "Only studies that have all of these in name, ID, accession number, date, modality or "
                   "description")
      ->type_name("");
  queried->add_flag("--series", o->query.withSeries, "One line a series");
  wholeNumber(queried->add_option("--limit", o->query.limit, "Most studies (default: 5000)"), 1, 1000000);
  queried->add_flag("--json", o->json, "Write one JSON object to stdout, as `volumen list` does");
  addExamples(*queried, {"volumen archive query main smith ct", "volumen archive query main today --json"});

  CLI::App* fetched = addNested(
      app, "fetch", "Fetch a study, or one of its series", *o, [o, &cancel] { return fetch(*o, cancel); },
      run);
  addName(*fetched, *o);
  fetched
      ->add_option("STUDY", o->study,
                   "The study's UID in `volumen archive query --json`, or STUDY/SERIES for one series")
      ->type_name("")
      ->required();
  fetched->add_option("-o,--output", o->folder, "Write to this folder, not into the index")
      ->type_name("FOLDER");
  addIndex(*fetched, o->index);
  fetched->add_flag("--json", o->json, "Write one JSON object to stdout");
  addExamples(*fetched,
              {"volumen archive fetch main 1.2.3", "volumen archive fetch main 1.2.3/1.2.3.1 -o fetched/"});

  CLI::App* kept = addLocal(
      app, "keep", "Keep a fetched study whatever the size limit, or list those that are kept",
      [=] { return keep(*o); }, run);
  CLI::Option* keptStudy =
      kept->add_option("STUDY", o->study, "The UID of a study that was fetched into the index")
          ->type_name("");
  kept->add_flag("--off", o->isLetGo, "Keep it no longer")->needs(keptStudy);
  addIndex(*kept, o->index);
  kept->add_flag("--json", o->json, "Write one JSON object to stdout");
  addExamples(*kept, {"volumen archive keep 1.2.3", "volumen archive keep 1.2.3 --off"});

  CLI::App* sent = addNested(
      app, "send", "Send files to an archive", *o, [o, &cancel] { return send(*o, cancel); }, run);
  addName(*sent, *o);
  sent->add_option("PATH", o->words, "Files, folders, index:STUDY[/SERIES] or archive:NAME/STUDY[/SERIES]")
      ->type_name("")
      ->required();
  sent->add_flag("--json", o->json, "Write one JSON object to stdout");
  addExamples(*sent, {"volumen archive send main scans/", "volumen archive send main index:12"});

  CLI::App* receiving = addNested(
      app, "receive", "Receive what peers send, until Ctrl-C", *o,
      [o, &cancel] {
        const auto all = archivesOf(*o);
        return all ? receiveFromPeers(*all, {o->path(), o->folder, o->index, o->json}, cancel)
                   : fail(all.message());
      },
      run);
  receiving->add_option("-o,--output", o->folder, "Write to this folder, not into the index")
      ->type_name("FOLDER");
  addIndex(*receiving, o->index);
  receiving->add_flag("--json", o->json, "Write one JSON object a line to stdout for each image");
  addExamples(*receiving, {"volumen archive receive", "volumen archive receive -o received/ --json"});
  addExamples(app, {"volumen archive test main", "volumen archive query main smith ct"});
  return [run] { return (*run)(); };
}

}  // namespace volumen
