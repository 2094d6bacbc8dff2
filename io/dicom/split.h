#pragma once

#include <string>
#include <vector>

#include "io/dicom/entries.h"
#include "io/dicom/separators.h"

namespace volumen::dicom {

/// Pictures of one stack, at most one at each position, with the attributes that separate them from others.
struct Split {
  Entries entries;
  std::vector<SplitBy> by;       ///< same as Series::splitBy
  std::string timePoint, label;  ///< same as in Series
  std::string warning;           ///< a sentence if they may not belong together, else empty
  bool isGuess = false;          ///< true if not even image numbers separate them: frames, no volume
  bool isCounted = false;  ///< true if separated by the rank of values that differ from position to position
};

/// Adds a separator's value and words to a split.
void addName(Split& split, const Separator& separator, const std::string& value, const std::string& words);

/// Orders values: as numbers if both are numbers, else as text in which digits count as numbers.
bool isBefore(const std::string& a, const std::string& b);

/// Splits ordered pictures by attributes that separate those at one position (io/dicom/separators.h), and
/// interleaved stacks (io/dicom/interleaved.h). If nothing separates them it uses their image numbers, with a
/// warning. The result is in order of values; with several attributes, in order of image numbers.
std::vector<Split> splitRepeats(const Entries& entries);

}  // namespace volumen::dicom
