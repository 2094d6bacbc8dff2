#include "app/batch/run_list.h"

#include <QImageReader>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "app/batch/stamps.h"
#include "app/command.h"
#include "app/progress.h"
#include "io/files/aside.h"
#include "io/files/output_file.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;
using LineJson = nlohmann::ordered_json;

// Returns the lines that a command wrote to stderr, without its name.
LineJson linesOf(const std::string& text) {
  LineJson all = LineJson::array();
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("volumen: ")) line.erase(0, 9);
    if (!line.empty()) all.push_back(line);
  }
  return all;
}

// Returns what a picture says of its error, in 1/255.
LineJson errorsIn(const std::string& picture) {
  LineJson errors = LineJson::object();
  if (!picture.ends_with(".png")) return errors;
  const QImageReader reader(QString::fromStdString(picture));
  for (const char* kind : {"estimated", "measured", "pilot"})
    if (const QString text = reader.text(QStringLiteral("volumen-error-") + QLatin1String(kind));
        !text.isEmpty())
      errors[kind] = text.toStdString();
  return errors;
}

// A piece to do. Its folder is made aside, so that it appears whole, with its stamp.
struct ToDo {
  Piece asked, made;  // `made` writes to the folder aside
  std::string stamp;
  std::optional<FolderAside> folder{};
  std::string problem{};  // why there is no folder aside

  std::string aside() const { return folder ? folder->path() + "/made" : std::string(); }
};

ToDo toDoOf(const Piece& piece, std::string stamp) {
  ToDo todo{piece, piece, std::move(stamp)};
  if (!piece.isFolder()) return todo;
  auto folder = FolderAside::in(fs::path(bareName(piece.outputs[0])).parent_path().string());
  if (!folder) {
    todo.problem = "Cannot make " + piece.outputs[0] + ": " + folder.message() + ".";
    return todo;
  }
  todo.folder.emplace(*std::move(folder));
  for (std::string& word : todo.made.words)
    if (word.starts_with("--output=")) word = "--output=" + todo.aside() + '/';
  return todo;
}

class ListRun {
 public:
  ListRun(std::size_t count, const PieceLimits& limits, const CancelToken& cancel)
      : count_(count), limits_(limits), cancel_(cancel), stamps_(cancel), progress_(terminalProgress()) {}

  void run(const std::vector<Piece>& group) {
    std::vector<ToDo> all;
    std::vector<Piece> made;
    for (const Piece& piece : group) {
      std::string stamp = stamps_.of(piece);
      if (isDone(piece, stamp)) {
        skip(piece);
        continue;
      }
      all.push_back(toDoOf(piece, std::move(stamp)));
      made.push_back(all.back().made);
    }
    std::unique_ptr<PieceProcess> process;
    for (std::size_t n = 0; n < all.size() && !cancel_.cancelled(); ++n) {
      if (!all[n].problem.empty()) {
        fail(all[n].asked, {{"warnings", LineJson::array({all[n].problem})}});
        continue;
      }
      if (!process) process = std::make_unique<PieceProcess>(made, limits_, cancel_);
      forgetStamp(all[n].asked);
      const PieceResult result = process->run(n);
      if (!result.exitStatus) process.reset();
      finish(all[n], result);
    }
  }

  ListResult result() && {
    result_.interrupted = cancel_.cancelled();
    return std::move(result_);
  }

 private:
  void skip(const Piece& piece) {
    ++result_.skipped;
    result_.there.push_back(piece);
    tell(piece, "skipped", LineJson::object());
  }

  // A stamp that no longer holds must not outlast a failure. That of a folder says whose the folder is.
  static void forgetStamp(const Piece& piece) {
    std::error_code ignored;
    if (!piece.isFolder()) fs::remove(stampFile(piece), ignored);
  }

  void fail(const Piece& piece, const LineJson& facts) {
    ++result_.failed;
    tell(piece, "failed", facts);
  }

  void finish(const ToDo& todo, const PieceResult& result) {
    const Piece& piece = todo.asked;
    LineJson facts = {{"seconds", std::round(result.seconds * 1000) / 1000},
                      {"peakMebibytes", result.peakBytes >> 20},
                      {"warnings", linesOf(result.error)}};
    if (result.exitStatus) facts["exit"] = *result.exitStatus;
    const bool isDoneWell = result.exitStatus == exitDone || result.exitStatus == exitLosses;
    if (cancel_.cancelled() && !isDoneWell) return tell(piece, "interrupted", facts);
    if (!result.exitStatus) facts["warnings"].push_back("Its process " + result.end + ".");
    if (!isDoneWell) return fail(piece, facts);
    if (const Status kept = keep(todo, result); !kept) {
      facts["warnings"].push_back(kept.message());
      return fail(piece, facts);
    }
    ++result_.done;
    result_.withLosses += result.exitStatus == exitLosses;
    result_.there.push_back(piece);
    if (LineJson errors = errorsIn(piece.outputs[0]); !errors.empty()) facts["error"] = std::move(errors);
    tell(piece, "done", facts);
  }

  static Status keep(const ToDo& todo, const PieceResult& result) {
    if (todo.asked.keepsStdout)
      if (Status s = writeWholeFile(todo.asked.outputs[0], result.out); !s) return s;
    return todo.folder ? moveFolder(todo) : writeStamp(todo.asked, todo.stamp);
  }

  // Gives a folder its name. A folder beside a stamp is of an earlier list and goes; another one stays. The
  // stamp comes before the name: wherever this process is killed, the next one knows whose the folder is.
  static Status moveFolder(const ToDo& todo) {
    const std::string name = bareName(todo.asked.outputs[0]);
    std::error_code problem;
    if (fs::exists(name, problem) && !fs::is_empty(name, problem)) {
      if (!fs::exists(stampFile(todo.asked), problem))
        return Error{name + " is there already, and no list made it: move it away."};
      fs::remove_all(name, problem);
    }
    if (Status s = writeStamp(todo.asked, todo.stamp, todo.aside()); !s) return s;
    fs::rename(todo.aside(), name, problem);
    if (problem && isDone(todo.asked, todo.stamp)) return {};  // another program has just made it
    return problem ? Status(Error{"Cannot make " + name + ": " + problem.message() + "."}) : Status();
  }

  void tell(const Piece& piece, const char* end, const LineJson& facts) {
    endTerminalProgress();
    LineJson line = {{"line", piece.line},
                     {"command", piece.command},
                     {"path", piece.path},
                     {"output", piece.outputs[0]},
                     {"end", end}};
    line.update(facts);
    std::cout << printableJson(line.dump(-1, ' ', false, LineJson::error_handler_t::replace)) << std::endl;
    if (progress_) progress_("working", ++told_, count_);
  }

  std::size_t count_, told_ = 0;
  PieceLimits limits_;
  CancelToken cancel_;
  Stamps stamps_;
  Progress progress_;
  ListResult result_;
};

}  // namespace

ListResult runList(const std::vector<std::vector<Piece>>& groups, const PieceLimits& limits,
                   const CancelToken& cancel) {
  std::size_t count = 0;
  for (const std::vector<Piece>& group : groups) count += group.size();
  ListRun list(count, limits, cancel);
  for (const std::vector<Piece>& group : groups)
    if (!cancel.cancelled()) list.run(group);
  endTerminalProgress();
  return std::move(list).result();
}

}  // namespace volumen
