#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/files/image_header.h"

namespace volumen {

/// The fields of a NRRD header (teem's "Definition of NRRD file format"), names in lower case without spaces
/// ("datafile"), and its key/value pairs; and where its samples lie. Counts are not yet set in `data`.
struct NrrdHeader {
  std::map<std::string, std::string> fields, keyValues;
  std::vector<std::uint64_t> sizes;
  SampleData data;

  /// The field's text; empty where it is absent.
  std::string field(const std::string& name) const;
};

/// Whether a file begins as a NRRD file does.
bool isNrrdHead(const std::string& head);

/// Parses the header of `path` (attached or detached) and finds its data files.
Result<NrrdHeader> readNrrdFields(const std::string& path);

/// The volumes of a NRRD file. Refused with a reason: colour pictures, complex numbers, block type.
Result<ImageHeader> readNrrdHeader(const std::string& path);

}  // namespace volumen
