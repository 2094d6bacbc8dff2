#pragma once

#include "app/batch/piece.h"

namespace volumen {

/// Writes the rows of all CSV files of a list as one table, with the line, path and file of each before them.
/// Columns of different commands stand side by side, in the order in which they first occur. The Error: a
/// file is not there or is no table, or the list has none.
Status gather(const std::vector<Piece>& pieces, const std::string& output);

/// Returns whether a file begins as the tables of gather() do.
bool isGatheredTable(const std::string& file);

}  // namespace volumen
