#pragma once

#include <vector>

#include "io/dicom/scan.h"
#include "io/dicom/transfer_syntax.h"
#include "io/regular_file.h"

namespace volumen::dicom {

/// A DICOM file up to its pixel data: its first bytes (all of an inflated data set) and the elements in them.
/// Filled in in this order: begin, meta (scanMeta), findSyntax, scan.
struct ScannedFile {
  MetaHeader meta;
  TransferSyntax syntax{"", "", Coding::native, {}, false};
  std::vector<std::uint8_t> head;
  std::uint64_t size = 0;          ///< of what offsets of elements count in
  std::uint64_t inflatedFrom = 0;  ///< where the deflated data set begins in the file; 0: it is not deflated
  DataSetScan dataSet;
  std::string remark;  ///< where `syntax` is not the one that the file names: a sentence without its name

  /// Reads what the meta header is looked for in.
  Status begin(const RegularFile& file);
  /// The transfer syntax that the file names, with the encoding that its bytes show.
  Status findSyntax();
  /// One pass over the data set. Fragments of pixels that are of another transfer syntax than the file names
  /// have theirs from then on.
  Status scan(const RegularFile& file);

 private:
  Status scanInflated(const RegularFile& file);
  Status scanPlain(const RegularFile& file);
  Status correctSyntax(const RegularFile& file);
};

}  // namespace volumen::dicom
