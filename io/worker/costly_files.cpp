#include "io/worker/costly_files.h"

#include <atomic>
#include <map>
#include <mutex>
#include <optional>

#include "io/file_state.h"

namespace volumen::worker {
namespace {

struct CostlyFiles {
  std::mutex mutex;
  std::map<std::pair<Handler, FileState>, Failure> all;
  std::atomic<bool> any = false;
};

CostlyFiles& costlyFiles() {
  static CostlyFiles files;
  return files;
}

}  // namespace

void rememberCost(Handler what, const std::string& path, Failure why) {
  if (why == Failure::none || isOfMachine(why)) return;
  const std::optional<FileState> state = fileState(path);
  if (!state) return;
  CostlyFiles& files = costlyFiles();
  const std::scoped_lock one(files.mutex);
  files.all.insert_or_assign({what, *state}, why);
  files.any = true;
}

Failure costBefore(Handler what, const std::string& path) {
  CostlyFiles& files = costlyFiles();
  if (!files.any) return Failure::none;
  const std::optional<FileState> state = fileState(path);
  if (!state) return Failure::none;
  const std::scoped_lock one(files.mutex);
  const auto found = files.all.find({what, *state});
  return found == files.all.end() ? Failure::none : found->second;
}

}  // namespace volumen::worker
