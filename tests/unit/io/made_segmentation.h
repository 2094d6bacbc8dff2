#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/unit/io/dicom_objects.h"

namespace volumen::tests {

/// A made-up segmentation: one segment in every frame, frames 2 mm apart along z.
struct MadeSegmentation {
  int columns = 3, rows = 3, frames = 2, bitsAllocated = 1;
  std::string type = "BINARY";
  std::vector<std::uint8_t> bytes = {0xff, 0xff, 0x03};
  std::function<void(DcmItem&)> edit = {};
};

/// Adds the functional groups of frame n.
inline void addFrame(DcmItem& data, int n) {
  DcmItem& groups = addItem(data, 0x5200, 0x9230);
  putWord(addItem(groups, 0x0062, 0x000a), 0x0062, 0x000b, 1);
  put(addItem(groups, 0x0020, 0x9113), 0x0020, 0x0032, "10\\20\\" + std::to_string(2 * n));
}

/// Writes the segmentation.
inline void writeSegmentation(const std::string& path, const MadeSegmentation& made) {
  writeObject(path, segmentationClass, [&](DcmItem& data) {
    put(data, 0x0062, 0x0001, made.type);
    put(data, 0x0028, 0x0004, "MONOCHROME2");
    put(data, 0x0028, 0x0008, std::to_string(made.frames));
    const unsigned words[][2] = {{0x0002, 1},
                                 {0x0010, unsigned(made.rows)},
                                 {0x0011, unsigned(made.columns)},
                                 {0x0100, unsigned(made.bitsAllocated)},
                                 {0x0101, unsigned(made.bitsAllocated)},
                                 {0x0102, unsigned(made.bitsAllocated - 1)},
                                 {0x0103, 0}};
    for (const auto& [element, value] : words) putWord(data, 0x0028, element, value);
    putWord(data, 0x0062, 0x000e, 100);
    putWord(addItem(data, 0x0062, 0x0002), 0x0062, 0x0004, 1);
    DcmItem& shared = addItem(data, 0x5200, 0x9229);
    put(addItem(shared, 0x0020, 0x9116), 0x0020, 0x0037, "1\\0\\0\\0\\1\\0");
    DcmItem& measures = addItem(shared, 0x0028, 0x9110);
    put(measures, 0x0028, 0x0030, "0.5\\0.7");
    put(measures, 0x0018, 0x0050, "2");
    for (int n = 0; n < made.frames; ++n) addFrame(data, n);
    data.putAndInsertUint8Array(DCM_PixelData, made.bytes.data(), made.bytes.size());
    if (made.edit) made.edit(data);
  });
}

}  // namespace volumen::tests
