#include "ui/data/series_pool.h"

#include <unistd.h>

#include <algorithm>

namespace volumen {

SeriesPool::SeriesPool(std::size_t budget) : budget_(budget) {}

std::size_t SeriesPool::partOfMemory(int percent) {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? std::size_t(pages) * std::size_t(bytes) / 100 * std::size_t(percent)
                                : std::size_t(1) << 30;
}

LoadedSeriesPtr SeriesPool::find(const PoolKey& key) {
  const auto found = std::ranges::find(held_, key, &Held::key);
  if (found == held_.end()) return nullptr;
  held_.splice(held_.begin(), held_, found);
  return held_.front().series;
}

void SeriesPool::put(const PoolKey& key, LoadedSeriesPtr series) {
  std::erase_if(held_, [&](const Held& h) { return h.key == key; });
  held_.push_front({key, std::move(series)});
  dropBeyondBudget();
}

void SeriesPool::setOnScreen(std::vector<PoolKey> keys, std::size_t elsewhere) {
  onScreen_ = std::move(keys);
  elsewhere_ = elsewhere;
  dropBeyondBudget();
}

void SeriesPool::setBudget(std::size_t bytes) {
  budget_ = bytes;
  dropBeyondBudget();
}

void SeriesPool::forget(const SeriesKey& key) {
  std::erase_if(held_, [&](const Held& h) { return h.key.series == key; });
}

bool SeriesPool::hasRoomFor(std::size_t bytes) const {
  std::size_t sum = bytes + elsewhere_;
  for (const Held& h : held_)
    if (std::ranges::find(onScreen_, h.key) != onScreen_.end()) sum += h.series->volume->bytes();
  return sum <= budget_;
}

std::size_t SeriesPool::bytes() const {
  std::size_t sum = 0;
  for (const Held& h : held_) sum += h.series->volume->bytes();
  return sum;
}

void SeriesPool::dropBeyondBudget() {
  std::size_t held = bytes() + elsewhere_;
  // The first was asked for just now.
  for (auto h = held_.end(); held > budget_ && h != held_.begin();) {
    if (--h == held_.begin() || std::ranges::find(onScreen_, h->key) != onScreen_.end()) continue;
    held -= h->series->volume->bytes();
    h = held_.erase(h);
  }
}

}  // namespace volumen
