#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/batch/piece.h"
#include "app/batch/stamps.h"
#include "io/files/aside.h"

namespace volumen {

/// Where pieces of one process write before what they made gets its name: a folder beside, one for all whose
/// outputs lie in one folder.
using FoldersAside = std::map<std::string, std::shared_ptr<FolderAside>>;

/// A piece whose output is made aside: a folder, or the file of a command that replaces none.
class MadeAside {
 public:
  /// Returns whether a piece is made aside. All others replace their outputs themselves.
  static bool isFor(const Piece& piece);

  /// Makes the place. The Error is a sentence for the user.
  static Result<MadeAside> of(const Piece& piece, FoldersAside& folders);

  /// Returns the piece that writes there.
  Piece piece() const;

  /// Returns what the command said, with the names that files get.
  std::string named(std::string text) const;

  /// Writes the stamp and gives what was made its name. What a list made before is replaced. The stamp comes
  /// before the name: wherever this process is killed, the next one knows whose the output is. The Error:
  /// something has this name that no list made, or nothing was made.
  Status move(const std::string& stamp, const StampedEnd& end) const;

  /// Removes what was made and has no name yet.
  void clear() const;

 private:
  MadeAside(const Piece& piece, std::string place) : asked_(piece), place_(std::move(place)) {}
  Result<FilesAside> made() const;
  Status giveName(const std::string& name, const std::string& file) const;

  Piece asked_;
  std::string place_;
};

}  // namespace volumen
