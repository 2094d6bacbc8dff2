#include "io/study/loaded.h"

#include <algorithm>

namespace volumen {

int Loaded::interpolatedSlices() const {
  return int(std::ranges::count_if(origins, &SliceOrigin::isInterpolated));
}

}  // namespace volumen
