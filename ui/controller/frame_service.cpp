#include "ui/controller/frame_service.h"

#include <algorithm>

#include "io/frames.h"
#include "io/study/frame_series.h"
#include "results/series/frames_window.h"
#include "ui/data/picture_index.h"
#include "ui/document/no_memory.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int mostAhead = 32;
constexpr int mostThreads = 4;  // views of mammograms

bool isGrey(const Series& series) {
  constexpr const char* colours[] = {"RGB", "YBR", "PALETTE"};
  return std::ranges::none_of(colours, [&](const char* name) { return series.valueType.starts_with(name); });
}

FrameKey middleOf(const Series& series) { return {keyOf(series), frameCount(series) / 2}; }

}  // namespace

std::size_t FrameService::defaultBudget() {
  return std::min(SeriesPool::partOfMemory(6), std::size_t(1) << 30);
}

FrameService::FrameService(std::size_t budget, QObject* parent) : QObject(parent), pool_(budget) {
  const int count = std::min(allowedThreads(), mostThreads);
  for (int n = 0; n < count; ++n) threads_.emplace_back([this] { run(); });
}

FrameService::~FrameService() {
  if (shared_) shared_->leave(this);
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

LoadedFramePtr FrameService::find(const FrameKey& key) {
  const std::lock_guard lock(mutex_);
  return pool_.find(key);
}

std::vector<int> FrameService::heldOf(const SeriesKey& series, const std::string& presentation) {
  const std::lock_guard lock(mutex_);
  return pool_.heldOf(series, presentation);
}

void FrameService::request(ViewId view, std::shared_ptr<const Series> series, int index, int step,
                           const std::string& presentation) {
  {
    const std::lock_guard lock(mutex_);
    wanted_[view] = {std::move(series), index, step, presentation};
    const auto failure = failures_.find(wanted_[view].key(0));
    const std::chrono::milliseconds rest(tryAgainMs);
    if (failure != failures_.end() && std::chrono::steady_clock::now() - failure->second.at >= rest)
      failures_.erase(failure);
    tellReady();
  }
  wake_.notify_all();
}

void FrameService::setBudget(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  pool_.setBudget(bytes);
}

void FrameService::shareBudgetOf(std::shared_ptr<SeriesPool> pool) {
  pool->host(this, {[this] {
                      const std::lock_guard lock(mutex_);
                      return pool_.bytes();
                    },
                    [this](std::size_t most) {
                      const std::lock_guard lock(mutex_);
                      pool_.dropBeyond(most);
                    }});
  const std::lock_guard lock(mutex_);
  shared_ = std::move(pool);
}

void FrameService::waitForViews(const CancelToken& cancel) {
  constexpr std::chrono::milliseconds lookEvery(50);
  const auto waits = [this](const auto& each) {
    const Wanted& wanted = each.second;
    return !wanted.told && (wanted.passed == 0 || isUnderWay(wanted.key(0)));
  };
  std::unique_lock lock(mutex_);
  while (!closing_ && !cancel.cancelled() && std::ranges::any_of(wanted_, waits))
    wake_.wait_for(lock, lookEvery);
}

void FrameService::drop(ViewId view) {
  const std::lock_guard lock(mutex_);
  wanted_.erase(view);
}

// Reports to views whose frame is ready or has failed.
void FrameService::tellReady() {
  for (auto& [view, wanted] : wanted_) {
    if (wanted.told || !isKnown(wanted.key(0))) continue;
    wanted.told = true;
    if (const LoadedFramePtr frame = pool_.find(wanted.key(0))) {
      tellReady(view, frame);
      continue;
    }
    const QString sentence = QString::fromStdString(failures_.at(wanted.key(0)).sentence);
    QMetaObject::invokeMethod(
        this, [this, view = view, key = wanted.key(0), sentence] { Q_EMIT failed(view, key, sentence); },
        Qt::QueuedConnection);
  }
}

void FrameService::tellReady(ViewId view, const LoadedFramePtr& frame) {
  QMetaObject::invokeMethod(
      this, [this, view, frame] { Q_EMIT ready(view, frame); }, Qt::QueuedConnection);
}

// Returns how many frames are read ahead; those of all views use at most half of the pool.
int FrameService::reach() const {
  const std::size_t room = pool_.budget() / 2 / frameBytes_ / std::max<std::size_t>(1, wanted_.size());
  return int(std::min<std::size_t>(room, mostAhead));
}

bool FrameService::isUnderWay(const FrameKey& key) const {
  return std::ranges::find(underWay_, key, &Reading::key) != underWay_.end();
}

std::optional<FrameService::Reading> FrameService::nextReading() {
  if (std::optional<Reading> middle = nextMiddle()) return middle;
  // Frames read ahead must not hold up those that views want, nor fill the memory.
  const int most = std::ranges::any_of(underWay_, &Reading::isAhead) ? 0 : reach();
  for (int ahead = 0; ahead <= most; ++ahead)
    if (std::optional<Reading> next = nextOf(ahead)) return next;
  return {};
}

// Returns the middle frame of a series if a view needs its greys for the frame that it wants.
std::optional<FrameService::Reading> FrameService::nextMiddle() const {
  for (const auto& [view, wanted] : wanted_) {
    const bool needsGreys = wanted.presentation.empty() && frameCount(*wanted.series) > 1;
    if (wanted.told || !needsGreys || !isGrey(*wanted.series)) continue;
    const FrameKey middle = middleOf(*wanted.series);
    if (!middleGreys_.contains(middle.series) && !isKnown(middle) && !isUnderWay(middle))
      return Reading{wanted.series, middle};
  }
  return {};
}

// Returns each frame once per request, so that reading ends even if the pool has no room for all. A view that
// moves on waits for the frame that is read for it, so that frames arrive in their order.
std::optional<FrameService::Reading> FrameService::nextOf(int ahead) {
  for (auto& [view, wanted] : wanted_) {
    const bool isServed =
        std::ranges::find(underWay_, std::optional(view), &Reading::view) != underWay_.end();
    if (ahead < wanted.passed || isServed) continue;
    wanted.passed = ahead + 1;
    const FrameKey key = wanted.key(ahead);
    const bool isThere = key.index >= 0 && key.index < frameCount(*wanted.series);
    if (!isThere || isKnown(key) || isUnderWay(key)) continue;
    return Reading{wanted.series, key, ahead == 0 ? std::optional(view) : std::nullopt, ahead > 0};
  }
  return {};
}

void FrameService::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::optional<Reading> reading;
    wake_.wait(lock, [&] { return closing_ || (reading = nextReading()); });
    if (closing_) return;
    (void)readHere(lock, *reading);
  }
}

// Releases the lock while the frame is read.
Result<LoadedFramePtr> FrameService::readHere(std::unique_lock<std::mutex>& lock, const Reading& reading) {
  underWay_.push_back(reading);
  lock.unlock();
  Result<LoadedFramePtr> frame = orNoMemory([&] { return read(reading); });
  lock.lock();
  end(reading, frame);
  // The shared pool calls back, so it is called without the lock.
  const std::shared_ptr<SeriesPool> shared = shared_;
  lock.unlock();
  if (shared) shared->fit();
  lock.lock();
  return frame;
}

Result<LoadedFramePtr> FrameService::readNow(const std::shared_ptr<const Series>& series, int index,
                                             const CancelToken& cancel) {
  const Reading reading{series, {keyOf(*series), index}};
  waitForViews(cancel);
  if (cancel.cancelled()) return Error{};
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return closing_ || !isUnderWay(reading.key); });
  if (LoadedFramePtr held = pool_.find(reading.key)) return held;
  return readHere(lock, reading);
}

// Requires the lock.
void FrameService::end(const Reading& reading, const Result<LoadedFramePtr>& frame) {
  underWay_.erase(std::ranges::find(underWay_, reading.key, &Reading::key));
  if (frame) {
    keep(*frame);
    if (reading.key == middleOf(*reading.series)) middleGreys_.try_emplace(reading.key.series);  // in colour
    // A view that moves faster than frames are read sees at least this one.
    if (reading.view && wanted_.contains(*reading.view) && wanted_[*reading.view].key(0) != reading.key)
      tellReady(*reading.view, *frame);
  } else {
    failures_[reading.key] = {frame.message(), std::chrono::steady_clock::now()};
  }
  tellReady();
  wake_.notify_all();
}

// Requires the lock.
void FrameService::keep(const LoadedFramePtr& frame) {
  frameBytes_ = std::max<std::size_t>(1, frame->bytes());
  pool_.put(frame);
  QMetaObject::invokeMethod(
      this, [this, series = frame->key.series] { Q_EMIT held(series); }, Qt::QueuedConnection);
}

Result<Presentation> FrameService::presentationOf(const std::string& path) {
  const std::lock_guard lock(sharedMutex_);
  if (const auto known = presentations_.find(path); known != presentations_.end()) return known->second;
  Result<Presentation> read = loadPresentation(path);
  if (read) presentations_.emplace(path, *read);
  return read;
}

Progress FrameService::progressOf(const Reading& reading) {
  constexpr std::size_t small = std::size_t(8) << 20;  // bytes: read before a percentage could be seen
  if (reading.isAhead) return {};
  return [this, key = reading.key, last = 0](const char*, std::size_t done, std::size_t total) mutable {
    const int percent = total < small ? 0 : int(100 * done / total);
    if (percent == std::exchange(last, percent)) return;
    QMetaObject::invokeMethod(
        this, [this, key, percent] { Q_EMIT progressed(key, percent); }, Qt::QueuedConnection);
  };
}

Result<LoadedFramePtr> FrameService::read(const Reading& reading) {
  if (reading.key.presentation.empty()) return readAcquired(reading, {});
  const Result<Presentation> presentation = presentationOf(reading.key.presentation);
  if (!presentation) return readAcquired(reading, presentation.message());
  if (!namesPicture(presentation->pictures, *reading.series, reading.key.index))
    return readAcquired(reading, {});
  Result<PresentedFrame> shown =
      loadFrame(*reading.series, reading.key.index, *presentation, progressOf(reading));
  if (!shown) return readAcquired(reading, shown.message());
  std::vector<std::string>& warnings = shown->frame.warnings;
  warnings.insert(warnings.end(), presentation->warnings.begin(), presentation->warnings.end());
  return shownFrame(*reading.series, reading.key, std::move(shown->frame), std::move(shown->how));
}

// `warning` says why the frame is not shown otherwise; it is empty if it should not be.
Result<LoadedFramePtr> FrameService::readAcquired(const Reading& reading, const std::string& warning) {
  Result<Frame> frame = loadFrame(*reading.series, reading.key.index, progressOf(reading));
  if (!frame) return frame.error();
  if (!warning.empty()) frame->warnings.push_back(warning);
  const Series& series = *reading.series;
  const int index = reading.key.index;
  if (frame->greys.empty() || frameCount(series) < 2)
    return shownFrame(series, reading.key, *std::move(frame));
  setOwnWindow(series, index, *frame);
  std::vector<NamedGrey> greys = middleGreys(reading, *frame);
  return shownFrame(series, reading.key, *std::move(frame), {}, std::move(greys));
}

void FrameService::setOwnWindow(const Series& series, int index, Frame& frame) {
  if (!frame.greys.empty() && frame.greys.front().ofValues)
    frame.greys.front().mapping.window = windowOf(series, index, frame);
}

// Returns none if the middle frame cannot be read or is in colour. Waits for another thread that reads it.
std::vector<NamedGrey> FrameService::middleGreys(const Reading& reading, const Frame& frame) {
  const FrameKey key = middleOf(*reading.series);
  std::unique_lock lock(mutex_);
  if (reading.key.index == key.index) return middleGreys_[key.series] = frame.greys;
  wake_.wait(lock, [&] { return closing_ || !isUnderWay(key); });
  const auto known = middleGreys_.find(key.series);
  if (known != middleGreys_.end()) return known->second;
  if (closing_) return {};
  const Reading middle{reading.series, key};
  const Result<LoadedFramePtr> read = readHere(lock, middle);
  return read ? middleGreys_[key.series] : std::vector<NamedGrey>();
}

Window FrameService::windowOf(const Series& series, int index, const Frame& frame) {
  const auto [first, last] = framesOfOneWindow(series, index);
  if (first == last) return frame.greys.front().mapping.window;
  const std::lock_guard lock(sharedMutex_);
  const auto known = windows_.find({keyOf(series), first});
  if (known != windows_.end()) return known->second;
  const std::optional<Window> window = windowOfFrames(series, first, last);
  if (window) windows_[{keyOf(series), first}] = *window;
  return window.value_or(frame.greys.front().mapping.window);
}

}  // namespace volumen
