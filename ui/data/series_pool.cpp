#include "ui/data/series_pool.h"

#include <algorithm>
#include <new>

#include "viewer/acceleration/stored_voxels.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

SeriesPool::SeriesPool(std::size_t budget, Available available)
    : available_(std::move(available)), budget_(budget) {}

std::size_t SeriesPool::partOfMemory(int percent) {
  return std::size_t(processMemory().most / 100 * std::uint64_t(percent));
}

std::uint64_t SeriesPool::availableNow() { return processMemory().available; }

// Counts only what the pool itself holds.
std::size_t SeriesPool::Held::bytes() const {
  return (series ? volumeBytes : 0) + (computed ? computed->bytes() : 0);
}

bool SeriesPool::Held::isInUse() const { return computed && computed.use_count() > 1; }

std::list<SeriesPool::Held>::const_iterator SeriesPool::withKey(const PoolKey& key) const {
  return std::ranges::find_if(held_, [&](const Held& h) { return h.series && h.key == key; });
}

LoadedSeriesPtr SeriesPool::find(const PoolKey& key) {
  const std::lock_guard lock(mutex_);
  const auto found = withKey(key);
  if (found == held_.end()) return nullptr;
  held_.splice(held_.begin(), held_, found);
  return found->series;
}

LoadedSeriesPtr SeriesPool::peek(const PoolKey& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = withKey(key);
  return found == held_.end() ? nullptr : found->series;
}

// Moves the first entry of this volume that `fits` to the front, or adds a new one there.
SeriesPool::Held& SeriesPool::firstOf(const VolumePtr& volume, const std::function<bool(const Held&)>& fits) {
  std::erase_if(held_, [](const Held& h) { return !h.series && !h.computed && h.volume.expired(); });
  const auto known =
      std::ranges::find_if(held_, [&](const Held& h) { return h.volume.lock() == volume && fits(h); });
  if (known == held_.end()) return held_.emplace_front(Held{volume, volume->bytes()});
  held_.splice(held_.begin(), held_, known);
  return held_.front();
}

void SeriesPool::put(const PoolKey& key, LoadedSeriesPtr series) {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  for (Held& h : held_)
    if (h.series && h.key == key) garbage.push_back(std::move(h.series));
  Held& first = firstOf(series->volume, [](const Held& h) { return !h.series; });
  first.key = key;
  first.series = std::move(series);
  letGoBeyond(budget_, garbage);
}

void SeriesPool::watch(const VolumePtr& volume) {
  const std::lock_guard lock(mutex_);
  firstOf(volume, [](const Held&) { return true; });
}

std::shared_ptr<StoredVoxels> SeriesPool::voxelsOf(const VolumePtr& volume) {
  const std::lock_guard lock(mutex_);
  Held& first = firstOf(volume, [](const Held&) { return true; });
  if (!first.computed)
    first.computed = std::make_shared<StoredVoxels>(volume, [this](std::size_t bytes) {
      if (!makeRoomFor(bytes)) throw std::bad_alloc();
    });
  return first.computed;
}

void SeriesPool::setOnScreen(std::vector<PoolKey> keys) {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  onScreen_ = std::move(keys);
  for (auto key = onScreen_.rbegin(); key != onScreen_.rend(); ++key)
    if (const auto shown = withKey(*key); shown != held_.end()) held_.splice(held_.begin(), held_, shown);
  letGoBeyond(budget_, garbage);
}

void SeriesPool::count(const void* holder, std::size_t bytes) {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  if (bytes == 0) {
    elsewhere_.erase(holder);
    return;
  }
  elsewhere_[holder] = bytes;
  letGoBeyond(budget_, garbage);
}

void SeriesPool::setBudget(std::size_t bytes) {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  budget_ = bytes;
  letGoBeyond(budget_, garbage);
}

std::size_t SeriesPool::budget() const {
  const std::lock_guard lock(mutex_);
  return budget_;
}

void SeriesPool::host(const void* holder, Guest guest) {
  const std::lock_guard lock(mutex_);
  guests_[holder] = std::move(guest);
}

void SeriesPool::leave(const void* holder) {
  const std::lock_guard lock(mutex_);
  guests_.erase(holder);
}

void SeriesPool::fit() {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  letGoBeyond(budget_, garbage);
}

bool SeriesPool::makeRoomFor(std::size_t bytes) {
  const std::uint64_t available = available_();
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  const std::size_t before = inMemory();
  const std::uint64_t most =
      std::min<std::uint64_t>(budget_, available < ~before ? before + available : ~std::uint64_t(0));
  const std::size_t after = letGoBeyond(most > bytes ? std::size_t(most) - bytes : 0, garbage);
  return bytes <= available || bytes - available <= before - after;
}

void SeriesPool::forget(const SeriesKey& key) {
  letGoIf([&](const Held& h) { return h.key.series == key; });
}

void SeriesPool::clear() {
  letGoIf([](const Held&) { return true; });
}

// Drops these series, and what was computed of them unless it is in use.
void SeriesPool::letGoIf(const std::function<bool(const Held&)>& isGone) {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  for (Held& h : held_) {
    if (!h.series || !isGone(h)) continue;
    garbage.push_back(std::move(h.series));
    if (!h.isInUse()) garbage.push_back(std::move(h.computed));
  }
}

bool SeriesPool::hasIdle() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(held_, [](const Held& h) { return !h.series && h.computed && !h.isInUse(); });
}

void SeriesPool::dropUnheld() {
  Garbage garbage;
  const std::lock_guard lock(mutex_);
  for (Held& h : held_)
    if (h.computed && !h.isInUse() && h.volume.use_count() == 1) garbage.push_back(std::move(h.computed));
}

bool SeriesPool::hasRoomFor(std::size_t bytes) const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = bytes + inMemory();
  for (const Held& h : held_) {
    if (h.computed && !h.isInUse()) sum -= h.computed->bytes();
    if (h.series && !isOnScreen(h)) sum -= h.volumeBytes;
  }
  return sum <= budget_;
}

std::size_t SeriesPool::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (const Held& h : held_) sum += h.bytes();
  return sum;
}

std::size_t SeriesPool::counted() const {
  const std::lock_guard lock(mutex_);
  return inMemory();
}

bool SeriesPool::isOnScreen(const Held& held) const {
  return std::ranges::find(onScreen_, held.key) != onScreen_.end();
}

// Volumes that were let go of here count as long as others hold them.
std::size_t SeriesPool::inMemory() const {
  std::size_t sum = 0;
  for (const auto& [holder, bytes] : elsewhere_) sum += bytes;
  for (const auto& [holder, guest] : guests_) sum += guest.bytes();
  for (const Held& h : held_)
    sum += (h.volume.expired() ? 0 : h.volumeBytes) + (h.computed ? h.computed->bytes() : 0);
  return sum;
}

// Returns what is left in memory, as if nobody else held what goes.
std::size_t SeriesPool::letGoBeyond(std::size_t most, Garbage& garbage) {
  std::size_t left = inMemory();
  for (auto h = held_.rbegin(); h != held_.rend(); ++h) {
    if (left <= most) return left;
    if (!h->computed || h->isInUse()) continue;
    left -= h->computed->bytes();
    garbage.push_back(std::move(h->computed));
  }
  for (auto h = held_.rbegin(); h != held_.rend(); ++h) {
    if (left <= most) return left;
    const bool isLatest = &*h == &held_.front();  // it was asked for just now
    if (isLatest || !h->series || isOnScreen(*h)) continue;
    left -= h->volumeBytes;
    garbage.push_back(std::move(h->series));
  }
  return letGuestsDropBeyond(most, left);
}

std::size_t SeriesPool::letGuestsDropBeyond(std::size_t most, std::size_t left) {
  for (const auto& [holder, guest] : guests_) {
    if (left <= most) return left;
    const std::size_t before = guest.bytes(), beyond = left - most;
    guest.dropBeyond(before - std::min(before, beyond));
    left = left - std::min(left, before) + guest.bytes();
  }
  return left;
}

}  // namespace volumen
