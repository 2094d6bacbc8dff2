#pragma once

#include "app/batch/piece.h"

namespace volumen {

/// One of several programs that do a list together.
struct Shard {
  int index = 1, count = 1;
};

/// Reads "I/N", 1 <= I <= N <= 1,000,000. Without text it is the task of a Slurm array (SLURM_ARRAY_TASK_ID,
/// _MIN, _STEP and _COUNT), else the only one. The Error: it is no such text, or the array is not evenly
/// numbered.
Result<Shard> shardOf(const std::string& text);

/// Returns the pieces of a shard, those of one series (Piece::group) together, so that it is read once. Each
/// piece is in exactly one shard. Shards get as many pieces as whole groups allow; a group that is larger
/// than a shard's part is divided.
std::vector<std::vector<Piece>> dealt(const std::vector<Piece>& pieces, Shard shard);

}  // namespace volumen
