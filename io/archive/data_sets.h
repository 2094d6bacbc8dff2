#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace volumen {

/// Returns the keys of a question (C-FIND, C-GET) at a level, "SERIES", in UTF-8. An empty UID is not a key.
DcmDataset keysAt(const char* level, const std::string& studyUid = "");
/// Returns the keys of queries for these instances of a series, a hundred instances a query. Without
/// instances, one query asks for the whole series.
std::vector<DcmDataset> keysForInstances(const std::string& studyUid, const std::string& seriesUid,
                                         const std::vector<std::string>& sopInstanceUids);
void putKey(DcmDataset& keys, const DcmTagKey& tag, const std::string& value);
/// Asks for these attributes.
void askFor(DcmDataset& keys, std::initializer_list<DcmTagKey> tags);

/// The values of a data set that an archive answers with.
class Answer {
 public:
  /// `usualSet`: character set where the answer names none. `data` must outlive this.
  Answer(DcmDataset& data, const std::string& usualSet);

  /// Returns a value without padding, in UTF-8.
  std::string text(const DcmTagKey& tag) const;
  /// Returns a date or time as dicom::dateOrTime() does.
  std::string date(const DcmTagKey& tag) const;
  /// Returns a number of things; -1 if the archive does not tell it.
  int count(const DcmTagKey& tag) const;

 private:
  std::string bytes(const DcmTagKey& tag) const;

  DcmDataset& data_;
  std::string set_;
};

}  // namespace volumen
