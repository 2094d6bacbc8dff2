#pragma once

#include "app/batch/piece_process.h"
#include "app/batch/shards.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// How many pieces of a list ended how.
struct ListResult {
  int done = 0, skipped = 0, withLosses = 0, failed = 0;
  bool interrupted = false;
  std::vector<Piece> there;  ///< pieces whose outputs are there
};

/// Does groups of pieces of a list (dealt()), each in a process of its own (with a limit of memory each
/// piece), and writes a JSON object a line to stdout for each: how it ended, exit status, seconds, peak of
/// memory, warnings, and the error that a picture states. A piece that is done (isDone()) is skipped. What
/// killed programs left in folders of outputs is removed. What happens to one piece costs its line alone.
/// There must be no threads and no workers. The limits are those of each piece.
ListResult runList(const std::vector<std::vector<Piece>>& groups, const PieceLimits& limits,
                   const CancelToken& cancel);

}  // namespace volumen
