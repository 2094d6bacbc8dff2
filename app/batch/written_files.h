#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/batch/piece.h"

namespace volumen {

/// Returns what a piece writes: outputs, pictures of a turn, tables of label images and its stamp.
std::vector<std::string> writtenNames(const Piece& piece);

/// How names of surfaces begin and end that a piece may write, a file for each segment: NAME-SEGMENT.stl.
struct SurfaceNames {
  std::string begin, end;
};

/// Returns the names of surfaces of a piece; empty: it writes no surfaces, or one file.
std::optional<SurfaceNames> surfaceNames(const Piece& piece);

/// Finds places of files as placeOfFile() has them, for many in few folders.
class Places {
 public:
  std::string operator()(const std::string& path);

 private:
  std::map<std::string, std::string> folders_;
};

/// Knows where the pieces of a list may write surfaces whose names only their segments tell.
class SurfacePlaces {
 public:
  void add(const Piece& piece, Places& placeOf);
  /// Returns the line of a piece that may write a file at a place, but not `besides`; 0: there is none.
  int lineOf(const std::string& place, int besides) const;

 private:
  std::map<std::pair<std::string, std::string>, int> lines_;  // by the place's begin and end
};

}  // namespace volumen
