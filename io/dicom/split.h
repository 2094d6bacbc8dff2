#pragma once

#include <string>
#include <vector>

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Pictures of one stack of which no two lie at one place, and what tells them from the others.
struct Split {
  Entries entries;
  std::vector<SplitBy> by;       ///< as Series has it
  std::string timePoint, label;  ///< as Series has them
  std::string warning;           ///< a sentence where only the order of numbers tells them apart; else empty
  bool isGuess = false;          ///< not even their numbers do: these are frames, no volume
};

/// Splits pictures in order by what tells apart those of one place (io/dicom/separators.h); by the order of
/// their numbers where nothing does, which is told. In the order of the values.
std::vector<Split> splitRepeats(const Entries& entries);

}  // namespace volumen::dicom
