#include "ui/data/frame_pool.h"

#include <algorithm>

namespace volumen {

LoadedFramePtr FramePool::find(const FrameKey& key) {
  const auto found = held_.find(key);
  if (found == held_.end()) return nullptr;
  found->second.lastUse = ++uses_;
  return found->second.frame;
}

std::vector<int> FramePool::heldOf(const SeriesKey& series, const std::string& presentation) const {
  std::vector<int> frames;
  for (auto held = held_.lower_bound({series, 0}); held != held_.end() && held->first.series == series;
       ++held)
    if (held->first.presentation == presentation) frames.push_back(held->first.index);
  return frames;
}

void FramePool::put(LoadedFramePtr frame) {
  const auto lastUse = [](const auto& held) { return held.second.lastUse; };
  if (const auto same = held_.find(frame->key); same != held_.end()) {
    bytes_ -= same->second.frame->bytes();
    held_.erase(same);
  }
  bytes_ += frame->bytes();
  while (!held_.empty() && bytes_ > budget_) {
    const auto oldest = std::ranges::min_element(held_, {}, lastUse);
    bytes_ -= oldest->second.frame->bytes();
    held_.erase(oldest);
  }
  const FrameKey key = frame->key;
  held_[key] = {std::move(frame), ++uses_};
}

}  // namespace volumen
