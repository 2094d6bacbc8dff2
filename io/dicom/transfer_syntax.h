#pragma once

#include <string>

#include "io/dicom/scan.h"

namespace volumen::dicom {

enum class Coding { native, rle, jpeg, jpegLs, jpeg2000, unsupported };

/// A transfer syntax (PS3.6 table A-1).
struct TransferSyntax {
  const char* uid;
  const char* name;  ///< name shown to the user
  Coding coding;
  Encoding encoding;
  bool deflated = false;
};

/// Returns the transfer syntax with that UID. Unknown ones are unsupported and have an empty name.
TransferSyntax transferSyntax(const std::string& uid);

}  // namespace volumen::dicom
