#pragma once

#include "io/study/series.h"

namespace volumen::dicom {

/// A file that gives no slice, and whose it is as far as its header could be read.
struct LostFile {
  Unread file;
  SeriesIdentity identity;
  bool ifNamedAlike = false;  ///< it counts only where it is named as the files of the series beside it are
};

/// Adds to each series what else is lost of it, and says all of that in its warnings: files whose header
/// names it, and those beside its files whose header could not be read, or which are named as these are.
void addUnread(const std::vector<LostFile>& lost, std::vector<Series>& volumes);

/// Says in the warnings of how slices lie (Stack) what could not be read: slices that were interpolated for
/// that are not called missing.
void warnOfUnread(const std::vector<Unread>& unread, const std::optional<Series::Regular>& regular,
                  std::vector<Warning>& warnings);

}  // namespace volumen::dicom
