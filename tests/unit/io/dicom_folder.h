#pragma once

#include <QTemporaryDir>
#include <string>
#include <vector>

#include "io/study/study.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

/// A temporary folder of synthetic DICOM files.
class DicomFolder {
 public:
  std::string path(const std::string& name = {}) const;
  void add(const std::string& name, const DicomPicture& picture,
           const char* syntax = "1.2.840.10008.1.2.1") const;
  /// Adds slices at these positions (mm along z) with value 100 z, named in another order: s100, s101, ...
  void addStack(const std::vector<double>& z) const;
  /// Opens the folder. Returns an empty study on failure.
  Study open() const;

 private:
  QTemporaryDir dir_;
};

/// Returns a slice at `z` mm with `value` in all pixels. InstanceNumber falls with rising value.
DicomPicture sliceAt(double z, int value);

/// Returns `prefix` followed by `n`.
std::string numbered(const char* prefix, int n);

/// Returns whether a warning is a sentence that contains `word`.
bool warns(const std::vector<Warning>& warnings, const std::string& word);

/// Returns the first value of each slice.
std::vector<float> firstOfEachSlice(const Volume& volume);

}  // namespace volumen::tests
