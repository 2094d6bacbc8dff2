#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/index_option.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/usage.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct ImportOptions {
  std::vector<std::string> paths;
  std::string index;
  bool copy = false, again = false, json = false;
};

Json toJson(const std::vector<Refused>& files) {
  Json list = Json::array();
  for (const Refused& file : files)
    list.push_back({{"path", pathForJson(file.path)}, {"reason", file.reason}});
  return list;
}

Json toJson(const ImportReport& report, const std::vector<std::string>& warnings) {
  return {{"files", report.files},
          {"new", report.added},
          {"changed", report.changed},
          {"unchanged", report.unchanged},
          {"gone", report.gone},
          {"notImages", report.notImages},
          {"refused", toJson(report.refused)},
          {"lacking", toJson(report.lacking)},
          {"warnings", warnings},
          {"cancelled", report.cancelled}};
}

void print(const ImportReport& report) {
  std::cout << report.files << " files: " << report.added << " new, " << report.changed << " changed, "
            << report.unchanged << " unchanged, " << report.gone << " gone, " << report.refused.size()
            << " refused";
  if (report.notImages > 0) std::cout << ", " << report.notImages << " not images";
  std::cout << '\n';
  for (const auto* files : {&report.refused, &report.lacking})
    for (const Refused& file : *files)
      std::cout << "  " << printable(file.path) << ": " << printable(file.reason) << '\n';
}

// Returns the index's notice and the paths without files.
std::vector<std::string> warningsOf(const Index& index, const ImportReport& report) {
  std::vector<std::string> warnings;
  if (!index.notice().empty()) warnings.push_back(index.notice());
  for (const std::string& path : report.empty)
    warnings.push_back(path + " holds no files: is its disk there? What the index has of it stays.");
  return warnings;
}

int statusOf(const ImportReport& report, const std::vector<std::string>& warnings) {
  if (report.added + report.changed + report.unchanged + report.gone > 0)
    return report.refused.empty() && report.lacking.empty() && warnings.empty() ? exitDone : exitLosses;
  if (!report.refused.empty())
    return fail("Nothing was imported: " + report.refused[0].path + ": " + report.refused[0].reason);
  return fail("Nothing was imported: no image was found.");
}

int run(const ImportOptions& options, const CancelToken& cancel) {
  Result<Index> index = Index::open(indexFolderOr(options.index));
  if (!index) return fail(index.message());
  const Result<ImportReport> report =
      options.copy
          ? index->importCopies(options.paths, copiesFolder(options.index), terminalProgress(), cancel)
          : index->import(options.paths, terminalProgress(), cancel, options.again);
  endTerminalProgress();
  if (!report && !index->notice().empty()) printNotes({index->notice()});
  if (!report) return fail(report.message());
  const std::vector<std::string> warnings = warningsOf(*index, *report);
  printNotes(warnings);
  if (options.json)
    std::cout << jsonText(toJson(*report, warnings));
  else
    print(*report);
  if (report->cancelled)
    return fail("Interrupted; what was read is kept, and the next import goes on from there.");
  return statusOf(*report, warnings);
}

}  // namespace

std::function<int()> makeImport(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ImportOptions>();
  addPaths(app, options->paths)->required();
  auto* copy = app.add_flag("--copy", options->copy,
                            "Copy the files into the index's folder first; else they stay where they are");
  app.add_flag("--again", options->again, "Read files again that could not be read before")->excludes(copy);
  addIndex(app, options->index);
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen import scans/", "volumen import scans/ --copy"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
