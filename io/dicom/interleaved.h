#pragma once

#include "io/dicom/separators.h"
#include "io/dicom/split.h"

namespace volumen::dicom {

/// Pictures of one stack, in order of place, by what one attribute says of them.
struct Kinds {
  std::vector<std::size_t> of;      ///< the kind of each picture, from 0, in the order of their first places
  std::vector<std::string> values;  ///< of each kind: that of its first picture
};

/// Kinds by the values of a separator. Sizes within 2 % are one kind; times are one where no longer time
/// lies between them than within one acquisition.
Kinds kindsOf(const Entries& entries, std::size_t separator);

/// Whether each kind is a stack by itself: three slices or more that lie even, but for some that are missing.
bool areEvenStacks(const Entries& entries, const Kinds& kinds);

/// Whether kinds are such stacks, and slices of each lie within the steps of others.
bool areStacksInEachOther(const Entries& entries, const Kinds& kinds);

/// Splits pictures of one volume of which kinds are stacks in each other; a kind of what differs within one
/// acquisition, too, only where all slices together are not even. Those that need no split stay.
std::vector<Split> splitInterleaved(const Split& split);

/// Whether pictures of one volume change back and forth between the kinds of a separator, as one acquisition
/// does not.
bool goesBackAndForth(const Entries& entries, std::size_t separator);

}  // namespace volumen::dicom
