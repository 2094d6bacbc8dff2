#pragma once

#include <map>
#include <string>

#include "app/batch/piece.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the file that says of what the outputs of a piece were made: beside the first one, with
/// ".volumen-stamp" behind its name.
std::string stampFile(const Piece& piece);

/// Makes the stamps of pieces. A stamp holds the version of the program, the command line, and names, sizes
/// and times of all files that are read, including scenes, shapes and the user's presets. A study of an
/// archive counts by its name alone.
class Stamps {
 public:
  explicit Stamps(const CancelToken& cancel) : cancel_(cancel) {}

  /// Returns the stamp of a piece, without its outputs. Files of a path are listed once.
  std::string of(const Piece& piece);

 private:
  const std::string& filesAt(const std::string& path);

  CancelToken cancel_;
  std::map<std::string, std::string> known_;  // hashes of files, by path
};

/// Returns whether a piece is done: its stamp file has this stamp, and all its outputs are there with the
/// sizes that they had.
bool isDone(const Piece& piece, const std::string& stamp);

/// Returns whether the stamp file of a piece names an output: an earlier run made it.
bool isStamped(const Piece& piece, const std::string& output);

/// Writes the stamp of a piece whose outputs are there; a folder is still at `aside`. The Error: an output is
/// missing, or the stamp cannot be written.
Status writeStamp(const Piece& piece, const std::string& stamp, const std::string& aside = {});

}  // namespace volumen
