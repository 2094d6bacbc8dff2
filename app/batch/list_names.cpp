#include "app/batch/list_names.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>

#include "app/batch/gather.h"
#include "app/batch/stamps.h"
#include "app/output_names.h"
#include "io/export/label_table.h"
#include "io/files/header_text.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

// A file that a piece writes, and the output that it belongs to.
struct WrittenName {
  std::string name, output;
};

int turntableOf(const Piece& piece) {
  constexpr std::string_view option = "--turntable=";
  constexpr int most = 9999;
  int pictures = 0;
  for (const std::string& word : piece.words)
    if (word.starts_with(option))
      std::from_chars(word.data() + option.size(), word.data() + word.size(), pictures);
  return piece.command == "render" ? std::clamp(pictures, 0, most) : 0;
}

bool isLabelImage(const Piece& piece, const std::string& output) {
  const std::string name = lowerCase(output);
  return piece.command == "segment" && (name.ends_with(".nii.gz") || name.ends_with(".mha"));
}

std::vector<WrittenName> namesOf(const Piece& piece) {
  std::vector<WrittenName> names;
  const int pictures = turntableOf(piece);
  for (std::size_t n = 0; n < piece.outputs.size(); ++n) {
    const std::string output = bareName(piece.outputs[n]);
    const bool isTurn = n == 0 && pictures > 0 && output.find('.') != output.npos;
    for (int picture = 0; isTurn && picture < pictures; ++picture)
      names.push_back({numberedName(output, picture), output});
    if (!isTurn) names.push_back({output, output});
    if (isLabelImage(piece, output)) names.push_back({labelTableOf(output), output});
  }
  return names;
}

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

// Places of files as placeOfFile() has them, for many in few folders.
class Places {
 public:
  std::string operator()(const std::string& path) {
    const fs::path bare(bareName(path)), name = bare.filename();
    std::error_code ignored;
    if (name.empty() || name == "." || name == ".." || fs::is_symlink(bare, ignored))
      return placeOfFile(path);
    const std::string parent = bare.has_parent_path() ? bare.parent_path().string() : ".";
    const auto [folder, isNew] = folders_.emplace(parent, "");
    if (isNew) folder->second = placeOfFile(parent);
    return (fs::path(folder->second) / name).string();
  }

 private:
  std::map<std::string, std::string> folders_;
};

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
          read_.emplace(placeOf_(path), piece.line);
      }
    for (const auto& [place, line] : read_)
      for (fs::path folder = fs::path(place).parent_path(); folder.has_relative_path();
           folder = folder.parent_path())
        if (!aroundRead_.emplace(folder.string(), line).second) break;
  }

  // The Error: two pieces write one file, or one writes into the folder of another.
  Status addWritten() {
    for (const Piece& piece : pieces_) {
      for (const WrittenName& written : namesOf(piece))
        if (Status s = add(written.name, piece.line); !s) return s;
      if (Status s = add(stampFile(piece), piece.line); !s) return s;
    }
    for (const Piece& piece : pieces_)
      for (const WrittenName& written : namesOf(piece))
        if (const std::string why = within(written.name); !why.empty())
          return wrong(piece.line, "it writes " + written.name + why);
    return {};
  }

  // The Error: a file that is read would be replaced.
  Status checkRead() {
    for (const Piece& piece : pieces_) {
      for (const WrittenName& written : namesOf(piece)) {
        const auto isOurs = [&] {
          return isStamped(piece, written.name) || isStamped(piece, written.output);
        };
        if (const std::string why = replaced(written.name, isOurs); !why.empty())
          return wrong(piece.line, "it writes " + written.name + why);
      }
      const std::string stamp = stampFile(piece);
      if (const std::string why = replaced(stamp, [] { return true; }); !why.empty())
        return wrong(piece.line, "its stamp is " + stamp + why);
    }
    return {};
  }

  Status checkTable(const std::string& table) {
    const auto written = written_.find(placeOf_(table));
    std::string why;
    if (written != written_.end()) why = ", which line " + std::to_string(written->second) + " writes";
    if (why.empty()) why = within(table);
    if (why.empty()) why = replaced(table, [&] { return isGatheredTable(table); });
    return why.empty() ? Status() : Error{"--gather " + table + why + ": choose another name."};
  }

 private:
  static Error wrong(int line, const std::string& why) {
    return Error{"Line " + std::to_string(line) + " of the list: " + why + ": choose another name."};
  }

  Status add(const std::string& name, int line) {
    const auto [other, isNew] = written_.emplace(placeOf_(name), line);
    if (isNew) return {};
    return Error{"Line " + std::to_string(line) + " of the list: it writes " + name + ", as line " +
                 std::to_string(other->second) + " does."};
  }

  // Returns which line writes the folder that a name lies in; empty: none.
  std::string within(const std::string& name) {
    const auto found = around(written_, fs::path(placeOf_(name)).parent_path());
    return found == written_.end() ? ""
                                   : ", in the folder that line " + std::to_string(found->second) + " writes";
  }

  // Returns which file a name would replace; empty: none.
  template <class IsOurs>
  std::string replaced(const std::string& name, const IsOurs& isOurs) {
    const std::string place = placeOf_(name);
    if (place == list_) return ", which is the list itself";
    const auto said = [](int line) { return ", which line " + std::to_string(line) + " reads"; };
    if (const auto found = read_.find(place); found != read_.end()) return said(found->second);
    if (const auto found = aroundRead_.find(place); found != aroundRead_.end())
      return ", the folder of a file that line " + std::to_string(found->second) + " reads";
    if (list_.starts_with(place + '/')) return ", the folder of the list";
    std::error_code ignored;
    if (!fs::exists(name, ignored)) return "";
    if (const auto found = around(read_, place); found != read_.end())
      return isOurs() ? "" : said(found->second);
    if ((studies_.empty() && ofStudies_.empty()) || isOurs()) return "";
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
