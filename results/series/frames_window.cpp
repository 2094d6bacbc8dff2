#include "results/series/frames_window.h"

#include <algorithm>

#include "io/frames.h"
#include "io/study/frame_series.h"
#include "viewer/slice/pixel_values.h"

namespace volumen {

std::pair<int, int> framesOfOneWindow(const Series& series, int index) {
  const int count = frameCount(series);
  if (!areMadeOneByOne(series)) return {0, count - 1};
  const auto isOfFile = [&](int n) {
    return series.files[std::size_t(n)] == series.files[std::size_t(index)];
  };
  int first = index, last = index;
  while (first > 0 && isOfFile(first - 1)) --first;
  while (last + 1 < count && isOfFile(last + 1)) ++last;
  return {first, last};
}

std::optional<Window> windowOfFrames(const Series& series, int first, int last) {
  constexpr int most = 9;
  const int sampled = std::min(last - first + 1, most);
  SharedWindow shared;
  bool isAnyRead = false;
  for (int n = 0; n < sampled; ++n) {
    const Result<Frame> sample =
        loadFrame(series, first + int(std::int64_t(n) * (last - first) / std::max(1, sampled - 1)));
    if (!sample) continue;
    isAnyRead = true;
    shared.add(sample->values, sample->padding);
  }
  return isAnyRead ? std::optional(shared.window()) : std::nullopt;
}

}  // namespace volumen
