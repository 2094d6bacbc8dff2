#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// Where the data set of a file lies, without file meta information, DataSetTrailingPadding and padding
/// behind it.
struct StoredDataSet {
  std::string syntax;  ///< transfer syntax of its bytes; uncompressed ones are told by the bytes themselves
  std::uint64_t begin = 0, end = 0;  ///< bytes of the file
  std::uint64_t nativeBytes = 0;     ///< size of its pixels without compression, as its header says
};

/// Returns where the data set of a file lies, found in a worker if there are any (io/worker). All its
/// elements are whole; compressed pixels are not looked at. The Error, without the file's name and full stop:
/// it is damaged, or is not what its header says.
Result<StoredDataSet> storedDataSet(const std::string& path, const CancelToken& cancel);

/// Returns the bytes of that data set in another transfer syntax, which is one without compression or its
/// own. Decompresses in a worker if there are any. The Error, without the file's name and full stop: this is
/// not possible.
Result<std::vector<std::uint8_t>> inSyntax(const std::string& path, const StoredDataSet& stored,
                                           const std::string& syntax, const CancelToken& cancel);

}  // namespace volumen::dicom
