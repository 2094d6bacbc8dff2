#pragma once

#include "io/study/series.h"

namespace volumen::dicom {

/// A file that gives no slice, with its identity as far as its header could be read.
struct LostFile {
  Unread file;
  SeriesIdentity identity;
  bool ifNamedAlike = false;  ///< true if it counts only when named like the files of a series beside it
};

/// Adds lost files to each series and warns of them. A file belongs to a series that its header names. Files
/// without readable header belong to a series whose files are beside them, and some only if named like those.
void addUnread(const std::vector<LostFile>& lost, std::vector<Series>& volumes);

/// Adds warnings about unread files to those about the layout of slices (Stack). Slices interpolated for
/// unread files are no longer called missing.
void warnOfUnread(const std::vector<Unread>& unread, const std::optional<Series::Regular>& regular,
                  std::vector<Warning>& warnings);

}  // namespace volumen::dicom
