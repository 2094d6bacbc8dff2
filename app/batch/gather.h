#pragma once

#include "app/batch/piece.h"

namespace volumen {

/// Writes the rows of all CSV files of a list into the table `output`. Line, path and file of their piece
/// stand before each row. Columns of different commands stand side by side, in the order in which they first
/// occur. Returns an Error if a file is missing or is no table, or if the list has none.
Status gather(const std::vector<Piece>& pieces, const std::string& output);

}  // namespace volumen
