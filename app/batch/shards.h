#pragma once

#include "app/batch/piece.h"

namespace volumen {

/// One of `count` programs that share a list. `index` begins at 1.
struct Shard {
  int index = 1, count = 1;
};

/// Reads "I/N" with 1 <= I <= N <= 1,000,000. An empty text stands for the task of a Slurm array
/// (SLURM_ARRAY_TASK_ID, _MIN, _STEP and _COUNT), or outside Slurm for the only program. Returns an Error if
/// the text is something else or the array is not evenly numbered.
Result<Shard> shardOf(const std::string& text);

/// Returns the pieces of a shard. Pieces of one series (Piece::group) are together, so that the series is
/// read once. Each piece is in exactly one shard. Shards are as equal as whole groups allow. A group that is
/// larger than a shard's part is divided.
std::vector<std::vector<Piece>> dealt(const std::vector<Piece>& pieces, Shard shard);

}  // namespace volumen
