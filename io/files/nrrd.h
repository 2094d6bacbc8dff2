#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/files/image_header.h"

namespace volumen {

/// The fields of a NRRD header (teem's "Definition of NRRD file format"), its key/value pairs and the
/// location of its samples. Field names are lower case without spaces ("datafile"). `data` has no counts yet.
struct NrrdHeader {
  std::map<std::string, std::string> fields, keyValues;
  std::vector<std::uint64_t> sizes;
  SampleData data;

  /// Returns the field's text; empty if it is absent.
  std::string field(const std::string& name) const;
};

/// True if a file begins like a NRRD file.
bool isNrrdHead(const std::string& head);

/// Parses the header of `path` (attached or detached) and finds its data files.
Result<NrrdHeader> readNrrdFields(const std::string& path);

/// Reads the header of a NRRD file. The Error gives a reason: colour images, complex numbers, block type.
Result<ImageHeader> readNrrdHeader(const std::string& path);

}  // namespace volumen
