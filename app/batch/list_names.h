#pragma once

#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Checks that no output of a list (including files beside it and stamps) is also the list, an input of any
/// piece, or an output of another piece, and that none lies in a folder that a piece reads. The same holds
/// for the file `table` of --gather. `list` and `table` are empty if
/// there is no such file. The Error names the line and the file, or says that the check was cancelled.
Status checkNames(const std::vector<Piece>& pieces, const std::string& list, const std::string& table,
                  const CancelToken& cancel);

}  // namespace volumen
