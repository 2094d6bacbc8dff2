#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/index_option.h"
#include "app/usage.h"

namespace volumen {

namespace {

struct ForgetOptions {
  std::vector<std::string> studies;
  std::string index;
  bool undo = false;
};

bool isMeant(const IndexedStudy& study, const std::string& word) {
  return study.studyUid == word || std::to_string(study.id) == word;
}

Result<std::vector<std::int64_t>> meantBy(const Index& index, const std::vector<std::string>& words) {
  const Result<std::vector<IndexedStudy>> all = index.studies();
  if (!all) return all.error();
  std::vector<std::int64_t> ids;
  for (const std::string& word : words) {
    const std::size_t before = ids.size();
    for (const IndexedStudy& study : *all)
      if (isMeant(study, word)) ids.push_back(study.id);
    if (ids.size() == before)
      return Error{"There is no study \"" + word +
                   "\" in the index: give its number in `volumen list`, or its UID."};
  }
  return ids;
}

int say(const char* what, std::size_t count) {
  std::cout << what << ' ' << count << (count == 1 ? " study" : " studies") << '\n';
  return exitDone;
}

int undo(Index& index) {
  const Result<std::vector<std::int64_t>> ids = index.lastForgotten();
  if (!ids) return fail(ids.message());
  if (ids->empty()) return fail("Nothing was forgotten that could come back.");
  if (const Status done = index.undoForget(*ids); !done) return fail(done.message());
  return say("Brought back", ids->size());
}

int run(const ForgetOptions& options) {
  if (options.undo && !options.studies.empty()) return failUsage("--undo takes no studies.");
  if (!options.undo && options.studies.empty())
    return failUsage("Missing STUDY: its number in `volumen list`, or its UID.");
  Result<Index> index = openExistingIndex(options.index);
  if (!index) return fail(index.message());
  if (options.undo) return undo(*index);
  const Result<std::vector<std::int64_t>> ids = meantBy(*index, options.studies);
  if (!ids) return fail(ids.message());
  if (const Status done = index->forget(*ids); !done) return fail(done.message());
  return say("Forgot", ids->size());
}

}  // namespace

std::function<int()> makeForget(CLI::App& app, const CancelToken&) {
  auto options = std::make_shared<ForgetOptions>();
  app.add_option("STUDY", options->studies, "A study's number in `volumen list`, or its UID")->type_name("");
  app.add_flag("--undo", options->undo, "Bring back what was forgotten last, within a day");
  addIndex(app, options->index);
  addExamples(app, {"volumen forget 1", "volumen forget --undo"});
  return [options] { return run(*options); };
}

}  // namespace volumen
