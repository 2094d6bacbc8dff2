#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QByteArray>
#include <algorithm>
#include <vector>

namespace volumen::tests {

/// Makes `data` a picture of `frames` frames of 4 x 3 pixels. Frame n has value n in all pixels.
inline void makeFrames(DcmDataset& data, int frames) {
  std::vector<Uint16> pixels;
  for (int n = 0; n < frames; ++n) pixels.insert(pixels.end(), 12, Uint16(n));
  data.putAndInsertString(DCM_NumberOfFrames, QByteArray::number(frames).constData());
  data.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
}

/// Returns the item of a functional group, shared (frame -1) or of one frame.
inline DcmItem& group(DcmDataset& data, int frame, const DcmTagKey& sequence) {
  const DcmTagKey& holder =
      frame < 0 ? DCM_SharedFunctionalGroupsSequence : DCM_PerFrameFunctionalGroupsSequence;
  DcmItem *item = nullptr, *found = nullptr;
  data.findOrCreateSequenceItem(holder, item, std::max(0, frame));
  item->findOrCreateSequenceItem(sequence, found);
  return *found;
}

}  // namespace volumen::tests
