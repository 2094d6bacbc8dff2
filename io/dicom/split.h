#pragma once

#include <string>
#include <vector>

#include "io/dicom/entries.h"
#include "io/dicom/separators.h"

namespace volumen::dicom {

/// Pictures of one stack of which no two lie at one place, and what tells them from the others.
struct Split {
  Entries entries;
  std::vector<SplitBy> by;       ///< as Series has it
  std::string timePoint, label;  ///< as Series has them
  std::string warning;           ///< a sentence where they may not belong together; else empty
  bool isGuess = false;          ///< not even their numbers do: these are frames, no volume
  bool isCounted = false;        ///< by the rank of values that differ from place to place
};

/// Adds what a separator says of a split to what is said already.
void addName(Split& split, const Separator& separator, const std::string& value, const std::string& words);

/// The order of values: by number where both are, else by text, in which digits count as numbers.
bool isBefore(const std::string& a, const std::string& b);

/// Splits pictures in order by what tells apart those of one place (io/dicom/separators.h) and stacks that
/// lie in each other (io/dicom/interleaved.h); by the order of their numbers where nothing does, which is
/// told. In the order of the values, of several attributes as the pictures are numbered.
std::vector<Split> splitRepeats(const Entries& entries);

}  // namespace volumen::dicom
