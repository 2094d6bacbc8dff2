#pragma once

#include <string>

#include "io/frames.h"
#include "io/open.h"

namespace volumen::tests {

/// Returns frame `n` of the only picture in a file, whether it is a volume or not.
inline Result<Frame> frameOf(const std::string& path, int n = 0) {
  const Result<Study> study = openStudy(path);
  if (!study) return study.error();
  if (!study->images.empty()) return loadFrame(study->images[0], n);
  if (!study->volumes.empty()) return loadFrame(study->volumes[0], n);
  return Error{path + ": " + (study->refused.empty() ? "no picture." : study->refused[0].reason)};
}

/// Returns the value at column x, row y.
inline float valueAt(const Frame& frame, int x, int y) {
  return frame.values[std::size_t(y) * std::size_t(frame.size.x) + std::size_t(x)];
}

}  // namespace volumen::tests
