#pragma once

#include <QTemporaryDir>
#include <string>
#include <vector>

#include "io/study/study.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

/// A folder of synthetic DICOM files, and what is found in it.
class DicomFolder {
 public:
  std::string path(const std::string& name = {}) const;
  void add(const std::string& name, const DicomPicture& picture,
           const char* syntax = "1.2.840.10008.1.2.1") const;
  /// Slices at these places (mm along z), of value 100 z, named against their order: s100, s101, ...
  void addStack(const std::vector<double>& z) const;
  /// What openStudy finds; an empty study where it fails.
  Study open() const;

 private:
  QTemporaryDir dir_;
};

/// A slice at `z` mm that holds `value` everywhere; InstanceNumber runs against the value.
DicomPicture sliceAt(double z, int value);

/// `prefix` with `n` behind it.
std::string numbered(const char* prefix, int n);

/// Whether a warning is a sentence that holds `word`.
bool warns(const std::vector<Warning>& warnings, const std::string& word);

/// The first value of each slice.
std::vector<float> firstOfEachSlice(const Volume& volume);

}  // namespace volumen::tests
