#pragma once

#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Checks that nothing that a list writes (outputs, the files beside them, stamps) is the list, a file that a
/// piece reads, or what another piece writes. A folder that is read may get new files, and those of an
/// earlier run may be replaced. Checks the same of the table that --gather writes. A list and a table that
/// are empty are none. The Error names the line and the file, or the check was cancelled.
Status checkNames(const std::vector<Piece>& pieces, const std::string& list, const std::string& table,
                  const CancelToken& cancel);

}  // namespace volumen
