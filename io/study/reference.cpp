#include "io/study/reference.h"

namespace volumen {

const char* kindName(ReferenceKind kind) {
  constexpr const char* names[] = {"presentation state", "key objects", "report", "contours", "segmentation"};
  return names[int(kind)];
}

}  // namespace volumen
