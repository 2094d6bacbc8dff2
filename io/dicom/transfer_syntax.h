#pragma once

#include <string>

#include "io/dicom/scan.h"

namespace volumen::dicom {

/// How pixels are coded.
enum class Coding { native, rle, jpeg, jpegLs, jpeg2000, unsupported };

/// One transfer syntax (PS3.6 table A-1).
struct TransferSyntax {
  const char* uid;
  const char* name;  ///< as said to the user
  Coding coding;
  Encoding encoding;
  bool deflated = false;
};

/// The transfer syntax of that UID; unknown ones are unsupported, their name is the empty string.
TransferSyntax transferSyntax(const std::string& uid);

}  // namespace volumen::dicom
