#include "app/batch/run_list.h"

#include <QImageReader>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "app/batch/made_aside.h"
#include "app/batch/stamps.h"
#include "app/command.h"
#include "app/progress.h"
#include "io/files/aside.h"
#include "io/files/output_file.h"

namespace volumen {

namespace {

using LineJson = nlohmann::ordered_json;

// Returns the sentences that a command wrote to stderr, without its name. Other lines, such as those of
// --explain, are none. Behind the last sentence of a command that failed, they belong to it, or they are what
// the system said of its end.
std::vector<std::string> sentencesIn(const std::string& text, bool isDoneWell) {
  constexpr std::string_view name = "volumen: ";
  std::vector<std::string> all, others;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(name))
      all.push_back(line.substr(name.size())), others.clear();
    else if (!line.empty())
      others.push_back(line);
  }
  if (!isDoneWell) all.insert(all.end(), others.begin(), others.end());
  return all;
}

bool isDoneWell(const PieceResult& result) {
  return result.exitStatus == exitDone || result.exitStatus == exitLosses;
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

// Returns what was measured of a piece.
LineJson measuresOf(const PieceResult& result) {
  LineJson facts = LineJson::object();
  if (result.seconds) facts["seconds"] = std::round(*result.seconds * 1000) / 1000;
  if (result.peakBytes) facts["peakMebibytes"] = *result.peakBytes >> 20;
  return facts;
}

struct ToDo {
  Piece asked;
  std::string stamp;
  std::optional<MadeAside> aside{};
  std::string problem{};  // why it cannot be made aside

  Piece made() const { return aside ? aside->piece() : asked; }
};

ToDo toDoOf(const Piece& piece, std::string stamp, FoldersAside& folders) {
  ToDo todo{piece, std::move(stamp)};
  if (!MadeAside::isFor(piece)) return todo;
  auto aside = MadeAside::of(piece, folders);
  if (aside)
    todo.aside.emplace(*std::move(aside));
  else
    todo.problem = aside.message();
  return todo;
}

std::string folderOfOutput(const std::string& output) {
  return std::filesystem::path(bareName(output)).parent_path().string();
}

// Removes what killed programs left in the folders that pieces write to.
void sweepFolders(const std::vector<std::vector<Piece>>& groups) {
  std::set<std::string> folders;
  for (const std::vector<Piece>& group : groups)
    for (const Piece& piece : group)
      for (const std::string& output : piece.outputs) folders.insert(folderOfOutput(output));
  for (const std::string& folder : folders) sweepAside(folder);
}

// Removes what the process of a piece left that was ended by an interruption.
void sweepAfterwards(const Piece& piece) {
  for (const std::string& output : piece.outputs) sweepAsideAgain(folderOfOutput(output));
}

class ListRun {
 public:
  ListRun(std::size_t count, const PieceLimits& limits, const CancelToken& cancel)
      : count_(count),
        limits_(limits),
        cancel_(cancel),
        stamps_(limits.bytes, cancel),
        progress_(terminalProgress()) {}

  void run(const std::vector<Piece>& group) {
    FoldersAside folders;
    std::vector<ToDo> all;
    std::vector<Piece> made;
    for (const Piece& piece : group) {
      if (cancel_.cancelled()) return;
      std::string stamp = stamps_.of(piece);
      if (isDone(piece, stamp)) {
        skip(piece);
        continue;
      }
      all.push_back(toDoOf(piece, std::move(stamp), folders));
      made.push_back(all.back().made());
    }
    std::unique_ptr<PieceProcess> process;
    for (std::size_t n = 0; n < all.size() && !cancel_.cancelled(); ++n) {
      if (!all[n].problem.empty()) {
        fail(all[n].asked, {{"warnings", LineJson::array({all[n].problem})}});
        continue;
      }
      if (!process) process = std::make_unique<PieceProcess>(made, limits_, cancel_);
      doOne(all[n], n, process);
    }
  }

  ListResult result() && {
    result_.interrupted = cancel_.cancelled();
    return std::move(result_);
  }

 private:
  void skip(const Piece& piece) {
    const StampedEnd end = stampedEnd(piece);
    ++result_.skipped;
    result_.withLosses += end.exitStatus == exitLosses;
    result_.there.push_back(piece);
    tell(piece, "skipped", {{"exit", end.exitStatus}, {"warnings", end.warnings}});
  }

  // While a command replaces its output itself, there is no stamp, which would be of another one. Where
  // memory is limited, each piece has a process of its own: what one keeps would leave less to the next.
  void doOne(const ToDo& todo, std::size_t index, std::unique_ptr<PieceProcess>& process) {
    std::optional<StampTaken> taken;
    if (!todo.aside) taken.emplace(todo.asked);
    PieceResult result = process->run(index);
    if (todo.aside) result.error = todo.aside->named(std::move(result.error));
    if (!result.exitStatus || limits_.bytes > 0) process.reset();
    if (!result.exitStatus && cancel_.cancelled()) sweepAfterwards(todo.asked);
    if (!finish(todo, result) && taken) taken->giveBack();
    if (todo.aside) todo.aside->clear();
  }

  bool fail(const Piece& piece, const LineJson& facts) {
    ++result_.failed;
    tell(piece, "failed", facts);
    return false;
  }

  // Returns whether it was done.
  bool finish(const ToDo& todo, const PieceResult& result) {
    const Piece& piece = todo.asked;
    LineJson facts = measuresOf(result);
    const bool isWell = isDoneWell(result);
    facts["warnings"] = sentencesIn(result.error, isWell);
    if (result.exitStatus) facts["exit"] = *result.exitStatus;
    if (cancel_.cancelled() && !isWell) {
      tell(piece, "interrupted", facts);
      return false;
    }
    if (!result.exitStatus) facts["warnings"].push_back("Its process " + result.end + ".");
    if (!isWell) return fail(piece, facts);
    if (const Status kept = keep(todo, result); !kept) {
      facts["warnings"].push_back(kept.message());
      facts["exit"] = int(exitFailed);
      return fail(piece, facts);
    }
    ++result_.done;
    result_.withLosses += result.exitStatus == exitLosses;
    result_.there.push_back(piece);
    if (LineJson errors = errorsIn(piece.outputs[0]); !errors.empty()) facts["error"] = std::move(errors);
    tell(piece, "done", facts);
    return true;
  }

  static Status keep(const ToDo& todo, const PieceResult& result) {
    if (todo.asked.keepsStdout)
      if (Status s = writeWholeFile(todo.asked.outputs[0], result.out); !s) return s;
    const StampedEnd end{*result.exitStatus, sentencesIn(result.error, true)};
    return todo.aside ? todo.aside->move(todo.stamp, end) : writeStamp(todo.asked, todo.stamp, end);
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
  sweepFolders(groups);
  ListRun run(count, limits, cancel);
  for (const std::vector<Piece>& group : groups)
    if (!cancel.cancelled()) run.run(group);
  endTerminalProgress();
  return std::move(run).result();
}

}  // namespace volumen
