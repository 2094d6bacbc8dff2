#include "viewer/plan/default_window.h"

namespace volumen {

Window defaultWindow(const VolumeFacts& facts) {
  if (facts.fileWindow) return *facts.fileWindow;
  const double width = facts.p999 - facts.p01;
  return {.centre = (facts.p01 + facts.p999) / 2, .width = width > 0 ? width : 1};
}

}  // namespace volumen
