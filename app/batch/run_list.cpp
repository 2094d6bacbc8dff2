#include "app/batch/run_list.h"

#include <QImageReader>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "app/batch/stamps.h"
#include "app/command.h"
#include "app/progress.h"
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

// Where a folder is made before it gets its name, so that it is there whole or not at all, with its stamp.
std::string asideOf(const Piece& piece) {
  const fs::path folder(piece.outputs[0].substr(0, piece.outputs[0].find_last_not_of('/') + 1));
  return (folder.parent_path() / ("." + folder.filename().string() + ".volumen-part")).string() + '/';
}

// Returns the piece with its folder aside.
Piece madeAside(Piece piece) {
  if (!piece.isFolder()) return piece;
  const std::string aside = asideOf(piece);
  for (std::string& word : piece.words)
    if (word.starts_with("--output=")) word = "--output=" + aside;
  return piece;
}

class ListRun {
 public:
  ListRun(std::size_t count, const PieceLimits& limits, const CancelToken& cancel)
      : count_(count), limits_(limits), cancel_(cancel), stamps_(cancel), progress_(terminalProgress()) {}

  void run(const std::vector<Piece>& group) {
    std::vector<Piece> asked, made;
    std::vector<std::string> stamps;
    for (const Piece& piece : group) {
      std::string stamp = stamps_.of(piece);
      if (isDone(piece, stamp)) {
        skip(piece);
        continue;
      }
      asked.push_back(piece), made.push_back(madeAside(piece)), stamps.push_back(std::move(stamp));
    }
    std::unique_ptr<PieceProcess> process;
    for (std::size_t n = 0; n < made.size() && !cancel_.cancelled(); ++n) {
      if (!process) process = std::make_unique<PieceProcess>(made, limits_, cancel_);
      clear(asked[n]);
      const PieceResult result = process->run(n);
      if (!result.exitStatus) process.reset();
      finish(asked[n], stamps[n], result);
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

  // A stamp that no longer holds must not outlast a failure.
  static void clear(const Piece& piece) {
    std::error_code ignored;
    if (piece.isFolder()) fs::remove_all(asideOf(piece), ignored);
    if (!piece.isFolder()) fs::remove(stampFile(piece), ignored);
  }

  void finish(const Piece& piece, const std::string& stamp, const PieceResult& result) {
    LineJson facts = {{"seconds", std::round(result.seconds * 1000) / 1000},
                      {"peakMebibytes", result.peakBytes >> 20},
                      {"warnings", linesOf(result.error)}};
    if (result.exitStatus) facts["exit"] = *result.exitStatus;
    const bool isDoneWell = result.exitStatus == exitDone || result.exitStatus == exitLosses;
    if (cancel_.cancelled() && !isDoneWell) return tell(piece, "interrupted", facts);
    const Status kept = isDoneWell ? keep(piece, stamp, result) : Status(Error{result.end});
    if (!kept && !result.exitStatus) facts["warnings"].push_back("Its process " + kept.message() + ".");
    if (!kept && isDoneWell) facts["warnings"].push_back(kept.message());
    if (!kept) {
      ++result_.failed;
      return tell(piece, "failed", facts);
    }
    ++result_.done;
    result_.withLosses += result.exitStatus == exitLosses;
    result_.there.push_back(piece);
    if (LineJson errors = errorsIn(piece.outputs[0]); !errors.empty()) facts["error"] = std::move(errors);
    tell(piece, "done", facts);
  }

  static Status keep(const Piece& piece, const std::string& stamp, const PieceResult& result) {
    if (piece.keepsStdout)
      if (Status s = writeWholeFile(piece.outputs[0], result.out); !s) return s;
    return piece.isFolder() ? moveFolder(piece, stamp) : writeStamp(piece, stamp);
  }

  // Gives a folder its name. One that an earlier stamp names goes; another one is not ours. The stamp comes
  // before the name: wherever this process is killed, the next one knows whose the folder is.
  static Status moveFolder(const Piece& piece, const std::string& stamp) {
    const std::string &name = piece.outputs[0], aside = asideOf(piece);
    std::error_code problem;
    const bool isOurs = fs::exists(stampFile(piece), problem);
    if (fs::exists(name, problem) && !fs::is_empty(name, problem)) {
      if (!isOurs) return Error{name + " is there already, and no list made it: move it away."};
      fs::remove_all(name, problem);
    }
    if (Status s = writeStamp(piece, stamp, aside); !s) return s;
    fs::rename(aside, name.substr(0, name.find_last_not_of('/') + 1), problem);
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
