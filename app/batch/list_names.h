#pragma once

#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "viewer/volume/cancel.h"

namespace volumen {

<<<<<<< HEAD
/// Checks that no output of a list (including files beside it and stamps) is also the list, an input of any
/// piece, or an output of another piece. An input folder may receive new files, and outputs of an earlier
/// run may be replaced. The same holds for the file `table` of --gather. `list` and `table` are empty if
/// there is no such file. The Error names the line and the file.
=======
/// Checks that nothing that a list writes (outputs, the files beside them, stamps) is the list, a file that a
/// piece reads, or what another piece writes. A folder that is read may get new files, and those of an
/// earlier run may be replaced. Checks the same of the table that --gather writes. A list and a table that
/// are empty are none. The Error names the line and the file, or the check was cancelled.
>>>>>>> h-batch2
Status checkNames(const std::vector<Piece>& pieces, const std::string& list, const std::string& table,
                  const CancelToken& cancel);

}  // namespace volumen
