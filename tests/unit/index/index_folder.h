#pragma once

#include <QTemporaryDir>
#include <map>
#include <set>

#include "io/index/index.h"
#include "tests/unit/io/dicom_folder.h"

namespace volumen::tests {

/// A file of a made-up study.
struct MadeFile {
  std::string name;  ///< below the folder; its folders are made
  std::string patient = "Test^Patient", study = "1.2.3.4", series = "1.2.3.4.5";
  int slice = 0;  ///< its place and its value
  std::string studyDescription = {};
  std::string institution = "Hôpital Saint-Louis";
};

/// A folder of data, and one for an index of it.
class IndexFolder {
 public:
  std::string data(const std::string& name = {}) const;
  std::string index() const;
  /// Writes a DICOM file; its SOP Instance UID is made of its series and slice.
  void add(const MadeFile& file) const;
  /// Opens the index; the test fails where it cannot be opened.
  Index open() const;
  /// Imports the data folder or a part of it into the index.
  ImportReport import(const std::string& part = {}) const;

 private:
  QTemporaryDir dir_;
};

/// What an index gives, as values; none where it fails.
std::vector<IndexedStudy> studiesIn(const Index& index, const StudyQuery& query = {});
std::vector<IndexedSeries> seriesIn(const Index& index, std::int64_t study);
std::vector<std::string> filesIn(const Index& index, std::int64_t study, std::int64_t series = 0);

/// All that lists show of an index, but numbers and times: equal where two indexes are.
std::string contentsOf(const Index& index);

}  // namespace volumen::tests
