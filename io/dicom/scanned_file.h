#pragma once

#include <vector>

#include "io/dicom/scan.h"
#include "io/dicom/transfer_syntax.h"
#include "io/regular_file.h"

namespace volumen::dicom {

/// A DICOM file up to its pixel data: its first bytes (all of an inflated data set) and their elements. Fill
/// it in this order: begin, meta (scanMeta), findSyntax, scan. readMeta() does the first three.
struct ScannedFile {
  MetaHeader meta;
  TransferSyntax syntax{"", "", Coding::native, {}, false};
  std::vector<std::uint8_t> head;
  std::uint64_t size = 0;          ///< size of the bytes that element offsets refer to
  std::uint64_t inflatedFrom = 0;  ///< offset of the deflated data set in the file; 0 if not deflated
  DataSetScan dataSet;
  std::string remark;  ///< set if `syntax` is not the one that the file names: a sentence without its name

  /// Reads the first bytes, which hold the meta header.
  Status begin(const RegularFile& file);
  /// Finds the transfer syntax that the file names, with the encoding that its bytes show.
  Status findSyntax();
  Status readMeta(const RegularFile& file);
  /// Scans the data set. If fragments of pixels are in another transfer syntax than the file names, `syntax`
  /// becomes theirs.
  Status scan(const RegularFile& file);
  /// Returns the transfer syntax of the data set's bytes after scan(). An uncompressed one is told by the
  /// bytes themselves. The Error: they are not encoded as the file says.
  Result<std::string> syntaxOfBytes() const;

 private:
  Status scanInflated(const RegularFile& file);
  Status scanPlain(const RegularFile& file);
  Status correctSyntax(const RegularFile& file);
};

}  // namespace volumen::dicom
