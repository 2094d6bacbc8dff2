#include "ui/data/frame_pool.h"

#include <algorithm>

namespace volumen {

LoadedFramePtr FramePool::find(const FrameKey& key) {
  const auto found = held_.find(key);
  if (found == held_.end()) return nullptr;
  found->second.lastUse = ++uses_;
  return found->second.frame;
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
