#include "io/study/derived_object.h"

namespace volumen {

const char* kindName(DerivedKind kind) {
  constexpr const char* names[] = {"presentation state", "key objects", "report", "contours", "segmentation"};
  return names[int(kind)];
}

}  // namespace volumen
