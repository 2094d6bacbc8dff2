#include "viewer/slice/frame.h"

namespace volumen {

const char* pixelSizeWord(PixelSizeKind kind) {
  switch (kind) {
    case PixelSizeKind::calibrated:
      return "calibrated";
    case PixelSizeKind::unstated:
      return "calibrated, unstated";
    case PixelSizeKind::atDetector:
      return "at detector";
    case PixelSizeKind::magnified:
      return "magnification corrected";
    case PixelSizeKind::filmScan:
      return "film scan";
    default:
      return "";
  }
}

}  // namespace volumen
