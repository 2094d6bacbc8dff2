#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/batch/piece.h"
#include "app/batch/stamps.h"
#include "io/files/aside.h"

namespace volumen {

/// The folders in which the pieces of one process write until their outputs are complete. The key is the
/// folder of the outputs, beside which each lies.
using FoldersAside = std::map<std::string, std::shared_ptr<FolderAside>>;

/// A piece whose output is first written to another place: a folder, or the file of a command that does not
/// replace files.
class MadeAside {
 public:
  /// Returns true if a piece is made aside. All others replace their outputs themselves.
  static bool isFor(const Piece& piece);

  /// Makes a place for the output, in a folder from `folders` or in a new one there. The Error is a sentence
  /// for the user.
  static Result<MadeAside> of(const Piece& piece, FoldersAside& folders);

  /// Returns the piece with the place as its output.
  Piece piece() const;

  /// Returns a text of the command with the final names of its files.
  std::string named(std::string text) const;

  /// Writes the stamp and moves the output to its final name, where it replaces the output of an earlier
  /// run. The stamp comes first. If this process is killed in between, the next run still knows whose the
  /// output is. Returns an Error if no list made what has this name, or if nothing was made.
  Status move(const std::string& stamp, const StampedEnd& end) const;

  /// Removes the place and everything that is still in it.
  void clear() const;

 private:
  MadeAside(const Piece& piece, std::string place) : asked_(piece), place_(std::move(place)) {}
  Result<FilesAside> made() const;
  Status giveName(const std::string& name, const std::string& file) const;

  Piece asked_;
  std::string place_;
};

}  // namespace volumen
