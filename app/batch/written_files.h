#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/batch/piece.h"

namespace volumen {

/// A file that a piece writes, and the output that it belongs to.
struct WrittenName {
  std::string name, output;
};

/// Returns what a piece writes besides its stamp: outputs, pictures of a turn and tables of label images.
std::vector<WrittenName> writtenNames(const Piece& piece);

/// Finds places of files as placeOfFile() has them, for many in few folders.
class Places {
 public:
  std::string operator()(const std::string& path);

 private:
  std::map<std::string, std::string> folders_;
};

/// Knows the files that the pieces of a list write, with their stamps, however they are spelled.
class WrittenFiles {
 public:
  explicit WrittenFiles(const std::vector<Piece>& pieces);

  /// Returns whether a piece writes a file, or the folder that it lies in.
  bool has(const std::string& file);

 private:
  Places placeOf_;
  std::set<std::string> places_;
};

}  // namespace volumen
