#include "app/batch/made_aside.h"

#include <filesystem>
#include <system_error>

#include "app/printable.h"
#include "io/regular_file.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

Error cannotMake(const std::string& output, const std::string& why) {
  return Error{"Cannot make " + output + ": " + why + "."};
}

bool isThere(const std::string& name) {
  std::error_code problem;
  return fs::exists(name, problem) && !(fs::is_directory(name, problem) && fs::is_empty(name, problem));
}

}  // namespace

bool MadeAside::isFor(const Piece& piece) { return piece.isFolder() || piece.command == "export"; }

Result<MadeAside> MadeAside::of(const Piece& piece, FoldersAside& folders) {
  const std::string output = bareName(piece.outputs[0]), parent = fs::path(output).parent_path().string();
  std::shared_ptr<FolderAside>& folder = folders[parent];
  if (!folder) {
    auto made = FolderAside::in(parent);
    if (!made) return cannotMake(output, made.message());
    folder = std::make_shared<FolderAside>(*std::move(made));
  }
  const std::string place = folder->path() + '/' + std::to_string(piece.line);
  std::error_code problem;
  fs::create_directory(place, problem);
  if (problem) return cannotMake(output, problem.message());
  return MadeAside(piece, place);
}

Piece MadeAside::piece() const {
  Piece made = asked_;
  for (std::string& word : made.words)
    if (word.starts_with("--output="))
      word =
          "--output=" + place_ + '/' + fileName(bareName(asked_.outputs[0])) + (asked_.isFolder() ? "/" : "");
  return made;
}

// Names in messages are made printable.
std::string MadeAside::named(std::string text) const {
  const std::string aside = place_ + '/',
                    parent = (fs::path(bareName(asked_.outputs[0])).parent_path() / "").string();
  return replaced(replaced(std::move(text), aside, parent), printable(aside), printable(parent));
}

// Returns the files and folders that were made, by the names that they get.
Result<FilesAside> MadeAside::made() const {
  const fs::path parent = fs::path(bareName(asked_.outputs[0])).parent_path();
  FilesAside all;
  std::error_code problem;
  for (const fs::directory_entry& entry : fs::directory_iterator(place_, problem))
    all[(parent / entry.path().filename()).string()] = entry.path().string();
  if (all.empty()) return Error{"It ended well, but " + asked_.outputs[0] + " is not there."};
  return all;
}

// Another program may do the same at once: then the folder of the later one stays. A folder cannot be
// replaced in one step, so this is tried again if the other one was faster.
Status MadeAside::giveName(const std::string& name, const std::string& file) const {
  constexpr int mostTries = 10;
  std::error_code problem;
  for (int n = 0; n < mostTries; ++n) {
    const std::string old = place_ + "/old" + std::to_string(n);
    if (asked_.isFolder()) fs::rename(name, old, problem);
    fs::rename(file, name, problem);
    if (!problem) return {};
  }
  return cannotMake(name, problem.message());
}

Status MadeAside::move(const std::string& stamp, const StampedEnd& end) const {
  const auto files = made();
  if (!files) return files.error();
  for (const auto& [name, file] : *files)
    if (isThere(name) && !isStamped(asked_, name))
      return Error{name + " is there already, and no list made it or all that it holds: move it away."};
  if (Status s = writeStamp(asked_, stamp, end, *files); !s) return s;
  for (const auto& [name, file] : *files)
    if (Status s = giveName(name, file); !s) return s;
  // Another program may have written its stamp meanwhile. If it replaces the output just now, it does this
  // last.
  if (!isDone(asked_, stamp)) static_cast<void>(writeStamp(asked_, stamp, end));
  return {};
}

void MadeAside::clear() const {
  std::error_code ignored;
  fs::remove_all(place_, ignored);
}

}  // namespace volumen
