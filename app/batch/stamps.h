#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "app/batch/written_files.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the file that says of what the outputs of a piece were made: beside the first one, with
/// ".volumen-stamp" behind its name.
std::string stampFile(const Piece& piece);

/// Makes the stamps of pieces. A stamp holds the version of the program, the command line, and names, sizes
/// and times of all files that are read, including scenes, shapes and the user's presets, but not what the
/// list writes into folders that are read. A study of an archive counts by its name alone. The limit of
/// memory counts too, as it may reduce what is drawn.
class Stamps {
 public:
  Stamps(const std::vector<Piece>& list, std::uint64_t mostBytes, const CancelToken& cancel)
      : written_(list), mostBytes_(mostBytes), cancel_(cancel) {}

  /// Returns the stamp of a piece, without its outputs. Files of a path are listed once.
  std::string of(const Piece& piece);

 private:
  const std::string& filesAt(const std::string& path);

  WrittenFiles written_;
  std::uint64_t mostBytes_;
  CancelToken cancel_;
  std::map<std::string, std::string> known_;  // hashes of files, by path
};

/// Returns whether a piece is done: its stamp file has this stamp, and all its outputs are there, folders
/// with the same files, in the sizes that they had.
bool isDone(const Piece& piece, const std::string& stamp);

/// Returns whether an earlier run made an output: the stamp file of the piece names it and, if it is a
/// folder, each file in it.
bool isStamped(const Piece& piece, const std::string& output);

/// The exit status and the warnings of a finished piece.
struct StampedEnd {
  int exitStatus = 0;
  std::vector<std::string> warnings{};  ///< sentences
};
/// Returns what the stamp file of a piece says of it.
StampedEnd stampedEnd(const Piece& piece);

/// Files and folders that lie aside, by the names that they get.
using FilesAside = std::map<std::string, std::string>;

/// Writes the stamp of a finished piece. What still lies `aside` counts as its first output.
/// The Error: an output is missing, or the stamp cannot be written.
Status writeStamp(const Piece& piece, const std::string& stamp, const StampedEnd& end,
                  const FilesAside& aside = {});

/// Removes the stamp file of a piece while it is done again, so that a killed program leaves none.
class StampTaken {
 public:
  explicit StampTaken(const Piece& piece);
  /// Puts it back, unless an output has changed since.
  void giveBack() const;

 private:
  Piece piece_;
  std::string text_, outputs_;
};

}  // namespace volumen
