#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/index_option.h"
#include "app/progress.h"
#include "app/usage.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct ImportOptions {
  std::vector<std::string> paths;
  std::string index;
  bool copy = false, json = false;
};

Json toJson(const ImportReport& report) {
  Json refused = Json::array();
  for (const Refused& file : report.refused)
    refused.push_back({{"path", file.path}, {"reason", file.reason}});
  return {{"files", report.files},         {"new", report.added}, {"changed", report.changed},
          {"unchanged", report.unchanged}, {"gone", report.gone}, {"refused", refused},
          {"cancelled", report.cancelled}};
}

void print(const ImportReport& report) {
  std::cout << report.files << " files: " << report.added << " new, " << report.changed << " changed, "
            << report.unchanged << " unchanged, " << report.gone << " gone, " << report.refused.size()
            << " refused\n";
  for (const Refused& file : report.refused)
    std::cout << "  " << printable(file.path) << ": " << printable(file.reason) << '\n';
}

int run(const ImportOptions& options, const CancelToken& cancel) {
  Result<Index> index = openIndex(options.index);
  if (!index) return fail(index.message());
  const Result<ImportReport> report =
      options.copy
          ? index->importCopies(options.paths, copiesFolder(options.index), terminalProgress(), cancel)
          : index->import(options.paths, terminalProgress(), cancel);
  endTerminalProgress();
  if (!report) return fail(report.message());
  if (options.json)
    std::cout << toJson(*report).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  else
    print(*report);
  if (report->cancelled)
    return fail("Interrupted; what was read is kept, and the next import goes on from there.");
  return exitDone;
}

}  // namespace

std::function<int()> makeImport(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<ImportOptions>();
  addPaths(app, options->paths)->required();
  app.add_flag("--copy", options->copy,
               "Copy the files into the index's folder first; else they stay where they are");
  addIndex(app, options->index);
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen import scans/", "volumen import scans/ --copy"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
