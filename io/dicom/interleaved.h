#pragma once

#include "io/dicom/separators.h"
#include "io/dicom/split.h"

namespace volumen::dicom {

/// The pictures of one stack, in order of position, by the value of one attribute.
struct Kinds {
  std::vector<std::size_t> of;      ///< kind of each picture, from 0, numbered by first position
  std::vector<std::string> values;  ///< value of each kind: that of its first picture
};

/// Groups pictures by the values of a separator. Sizes within 2 % are one kind. Times are one kind if no gap
/// between them is longer than within one acquisition.
Kinds kindsOf(const Entries& entries, std::size_t separator);

/// Returns whether each kind is an even stack: three or more slices at equal distances, some missing allowed.
bool areEvenStacks(const Entries& entries, const Kinds& kinds);

/// Returns whether the kinds are even stacks that interleave: slices of each lie within the steps of others.
bool areStacksInEachOther(const Entries& entries, const Kinds& kinds);

/// Splits a volume whose kinds are interleaved stacks. Attributes that vary within one acquisition split it
/// only if all slices together are uneven. Returns other volumes unchanged.
std::vector<Split> splitInterleaved(const Split& split);

/// Returns whether pictures alternate between the kinds of a separator, as they do not within one
/// acquisition.
bool goesBackAndForth(const Entries& entries, std::size_t separator);

}  // namespace volumen::dicom
