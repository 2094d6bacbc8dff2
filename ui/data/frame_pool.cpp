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
  if (const auto same = held_.find(frame->key); same != held_.end()) {
    bytes_ -= same->second.frame->bytes();
    held_.erase(same);
  }
  const std::size_t bytes = frame->bytes();
  dropBeyond(budget_ - std::min(budget_, bytes));
  bytes_ += bytes;
  const FrameKey key = frame->key;
  held_[key] = {std::move(frame), ++uses_};
}

void FramePool::setBudget(std::size_t bytes) {
  budget_ = bytes;
  dropBeyond(budget_);
}

void FramePool::dropBeyond(std::size_t most) {
  std::vector<decltype(held_)::iterator> unused;
  for (auto held = held_.begin(); held != held_.end(); ++held)
    if (held->second.frame.use_count() == 1) unused.push_back(held);
  std::ranges::sort(unused, {}, [](const auto& held) { return held->second.lastUse; });
  for (const auto& oldest : unused) {
    if (bytes_ <= most) return;
    bytes_ -= oldest->second.frame->bytes();
    held_.erase(oldest);
  }
}

}  // namespace volumen
