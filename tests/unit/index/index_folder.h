#pragma once

#include <QTemporaryDir>
#include <map>
#include <set>

#include "io/index/index.h"
#include "tests/unit/io/dicom_folder.h"

namespace volumen::tests {

/// Describes one file of a made-up study.
struct MadeFile {
  std::string name;  ///< path below the folder; missing folders are created
  std::string patient = "Test^Patient", study = "1.2.3.4", series = "1.2.3.4.5";
  int slice = 0;  ///< position along the stack and voxel value
  std::string studyDescription = {};
  std::string institution = "Hôpital Saint-Louis";
  std::string date = "20261124";  ///< of the study
};

/// A temporary folder of data, and another for its index.
class IndexFolder {
 public:
  std::string data(const std::string& name = {}) const;
  std::string index() const;
  /// Writes a DICOM file. Its SOP Instance UID derives from its series and slice.
  void add(const MadeFile& file) const;
  /// Opens the index. Fails the test if it cannot be opened.
  Index open() const;
  /// Imports the data folder or `part` of it into the index.
  ImportReport import(const std::string& part = {}) const;

 private:
  QTemporaryDir dir_;
};

/// Return the contents of an index as values; empty on errors.
std::vector<IndexedStudy> studiesIn(const Index& index, const StudyQuery& query = {});
std::vector<IndexedSeries> seriesIn(const Index& index, std::int64_t study);
std::vector<std::string> filesIn(const Index& index, std::int64_t study, std::int64_t series = 0);

/// Returns all contents of an index that lists show, without ids and times. Equal indexes give equal texts.
std::string contentsOf(const Index& index);

}  // namespace volumen::tests
