#include "app/batch/list_names.h"

#include <filesystem>
#include <map>
#include <utility>

#include "app/batch/written_files.h"
#include "io/dicom/directory.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

constexpr const char* otherName = ": choose another name.";

// Returns the first of a place and the folders around it that a map has.
template <class Map>
auto around(const Map& map, fs::path place) {
  auto found = map.find(place.string());
  while (found == map.end() && place.has_relative_path()) {
    place = place.parent_path();
    found = map.find(place.string());
  }
  return found;
}

// Finds what a list reads and writes by its place, however it is spelled.
class ListNames {
 public:
  ListNames(const std::vector<Piece>& pieces, const std::string& list, const CancelToken& cancel)
      : pieces_(pieces), cancel_(cancel) {
    if (!list.empty() && list != "-") list_ = placeOf_(list);
    for (const Piece& piece : pieces)
      for (const std::string& path : piece.reads) {
        if (path.starts_with("index:"))
          studies_.emplace(path, piece.line);
        else if (!isStudyName(path))
          addRead(path, piece.line);
      }
    for (const auto& [place, line] : read_)
      for (fs::path folder = fs::path(place).parent_path(); folder.has_relative_path();
           folder = folder.parent_path())
        if (!aroundRead_.emplace(folder.string(), line).second) break;
  }

  // The Error: two pieces write one file, or one writes into the folder of another.
  Status addWritten() {
    for (const Piece& piece : pieces_) {
      if (cancel_.cancelled()) return interrupted();
      for (const std::string& name : writtenNames(piece))
        if (Status s = add(name, piece.line); !s) return s;
      surfaces_.add(piece, placeOf_);
    }
    for (const Piece& piece : pieces_)
      for (const std::string& name : writtenNames(piece)) {
        const std::string why = within(name) + asSurface(name, piece.line);
        if (!why.empty()) return wrong(piece.line, name + why + otherName);
      }
    return {};
  }

  // The Error: a file that is read would be replaced, or a folder that is read would get another one.
  Status checkRead() {
    for (const Piece& piece : pieces_) {
      if (cancel_.cancelled()) return interrupted();
      for (const std::string& name : writtenNames(piece))
        if (const std::string why = disturbed(name); !why.empty()) return wrong(piece.line, name + why);
    }
    return {};
  }

  Status checkTable(const std::string& table) {
    const auto written = written_.find(placeOf_(table));
    std::string why;
    if (written != written_.end()) why = ", which line " + std::to_string(written->second) + " writes";
    if (why.empty()) why = within(table);
    why = why.empty() ? disturbed(table) : why + otherName;
    return why.empty() ? Status() : Error{"--gather " + table + why};
  }

 private:
  static Error interrupted() { return Error{"Interrupted; nothing was done."}; }

  static Error wrong(int line, const std::string& what) {
    return Error{"Line " + std::to_string(line) + " of the list: it writes " + what};
  }

  // A DICOMDIR stands for its folder.
  void addRead(const std::string& path, int line) {
    const std::string place = placeOf_(path);
    if (read_.emplace(place, line).second && dicom::isDirectoryFile(place))
      read_.emplace(fs::path(place).parent_path().string(), line);
  }

  Status add(const std::string& name, int line) {
    const auto [other, isNew] = written_.emplace(placeOf_(name), line);
    if (isNew) return {};
    return wrong(line, name + ", as line " + std::to_string(other->second) + " does.");
  }

  // Returns which line writes the folder that a name lies in; empty: none.
  std::string within(const std::string& name) {
    const auto found = around(written_, fs::path(placeOf_(name)).parent_path());
    return found == written_.end() ? ""
                                   : ", in the folder that line " + std::to_string(found->second) + " writes";
  }

  // Returns which other line may write a name as a surface of a segment; empty: none.
  std::string asSurface(const std::string& name, int line) {
    const int other = surfaces_.lineOf(placeOf_(name), line);
    return other == 0 ? "" : ", as line " + std::to_string(other) + " may do, a file for each segment";
  }

  // Returns which file a name would replace, or which folder it would add to, and what to do; empty: none.
  std::string disturbed(const std::string& name) {
    const std::string place = placeOf_(name);
    if (const std::string why = replaced(name, place); !why.empty()) return why + otherName;
    const fs::path folder = fs::path(name).parent_path();
    for (const std::string& at :
         {fs::path(place).parent_path().string(), placeOf_(folder.empty() ? "." : folder.string())})
      if (const auto found = around(read_, at); found != read_.end())
        return ", in the folder that line " + std::to_string(found->second) +
               " reads: choose another folder.";
    return "";
  }

  // Returns which file a name would replace; empty: none.
  std::string replaced(const std::string& name, const std::string& place) {
    if (place == list_) return ", which is the list itself";
    const auto said = [](int line) { return ", which line " + std::to_string(line) + " reads"; };
    if (const auto found = read_.find(place); found != read_.end()) return said(found->second);
    if (const auto found = aroundRead_.find(place); found != aroundRead_.end())
      return ", the folder of a file that line " + std::to_string(found->second) + " reads";
    if (list_.starts_with(place + '/')) return ", the folder of the list";
    std::error_code ignored;
    if (!fs::exists(name, ignored)) return "";
    const auto& files = filesOfStudies();
    const auto found = files.find(place);
    return found == files.end() ? "" : said(found->second);
  }

  // Asks the index only if something is there that could be replaced.
  const std::map<std::string, int>& filesOfStudies() {
    for (const auto& [study, line] : std::exchange(studies_, {}))
      if (const auto files = filesOfPath(study, {}, cancel_); files)
        for (const std::string& file : *files) ofStudies_.emplace(placeOf_(file), line);
    return ofStudies_;
  }

  const std::vector<Piece>& pieces_;
  CancelToken cancel_;
  Places placeOf_;
  SurfacePlaces surfaces_;
  std::string list_;
  std::map<std::string, int> read_, aroundRead_, written_, studies_, ofStudies_;  // lines
};

}  // namespace

Status checkNames(const std::vector<Piece>& pieces, const std::string& list, const std::string& table,
                  const CancelToken& cancel) {
  ListNames names(pieces, list, cancel);
  if (Status s = names.addWritten(); !s) return s;
  if (Status s = names.checkRead(); !s) return s;
  return table.empty() ? Status() : names.checkTable(table);
}

}  // namespace volumen
