#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the name of a piece's stamp file: its first output with ".volumen-stamp" at the end.
std::string stampFile(const Piece& piece);

/// Makes the stamps of pieces. A stamp identifies what an output was made from: the version of the program,
/// the command line, and names, sizes and times of all files read. These include scenes, shapes and the
/// user's presets. A study of an archive is identified only by its name. The memory limit `mostBytes` is part
/// of the stamp, as it may reduce what is drawn.
class Stamps {
 public:
  Stamps(std::uint64_t mostBytes, const CancelToken& cancel) : mostBytes_(mostBytes), cancel_(cancel) {}

  /// Returns the stamp of a piece, which does not depend on its outputs. The files at a path are listed only
  /// once.
  std::string of(const Piece& piece);

 private:
  const std::string& filesAt(const std::string& path);

  std::uint64_t mostBytes_;
  CancelToken cancel_;
  std::map<std::string, std::string> known_;  // hashes of the files at a path, by path
};

/// Returns true if a piece is done: its stamp file holds `stamp`, and all outputs exist with the same sizes.
/// Folders must have the same files.
bool isDone(const Piece& piece, const std::string& stamp);

/// Returns true if an earlier run made an output: the piece's stamp file names it and, for a folder, each
/// file in it.
bool isStamped(const Piece& piece, const std::string& output);

/// The exit status and the warnings of a finished piece.
struct StampedEnd {
  int exitStatus = 0;
  std::vector<std::string> warnings{};  ///< whole sentences for the user
};
/// Returns the exit status and warnings in a piece's stamp file.
StampedEnd stampedEnd(const Piece& piece);

/// Where files and folders lie before they are moved, by their final names.
using FilesAside = std::map<std::string, std::string>;

/// Writes the stamp of a finished piece. Files in `aside` stand for its first output, under their final
/// names. Returns an Error if an output is missing or the stamp cannot be written.
Status writeStamp(const Piece& piece, const std::string& stamp, const StampedEnd& end,
                  const FilesAside& aside = {});

/// Removes the stamp file of a piece that is done again, so that a killed program leaves none.
class StampTaken {
 public:
  explicit StampTaken(const Piece& piece);
  /// Writes the stamp file again, unless an output has changed since.
  void giveBack() const;

 private:
  Piece piece_;
  std::string text_, outputs_;
};

}  // namespace volumen
