#include "ui/controller/frame_service.h"

#include <algorithm>

#include "io/frames.h"
#include "ui/data/frame_series.h"
#include "ui/data/picture_index.h"

namespace volumen {

namespace {

constexpr int mostAhead = 32;

// Returns the first and last frame that share a window.
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

}  // namespace

std::size_t FrameService::defaultBudget() {
  return std::min(SeriesPool::partOfMemory(6), std::size_t(1) << 30);
}

FrameService::FrameService(std::size_t budget, QObject* parent)
    : QObject(parent), pool_(budget), thread_([this] { run(); }) {}

FrameService::~FrameService() {
  if (shared_) shared_->leave(this);
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  thread_.join();
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
  wake_.notify_one();
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

// Returns each frame once per request, so that reading ends even if the pool has no room for all.
std::optional<FrameService::Reading> FrameService::nextReading() {
  const int most = reach();
  for (int ahead = 0; ahead <= most; ++ahead)
    for (auto& [view, wanted] : wanted_) {
      if (ahead < wanted.passed) continue;
      wanted.passed = ahead + 1;
      const FrameKey key = wanted.key(ahead);
      if (key.index < 0 || key.index >= frameCount(*wanted.series) || isKnown(key)) continue;
      return Reading{wanted.series, key, ahead == 0 ? std::optional(view) : std::nullopt};
    }
  return {};
}

void FrameService::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::optional<Reading> reading;
    wake_.wait(lock, [&] { return closing_ || (reading = nextReading()); });
    if (closing_) return;
    lock.unlock();
    Result<LoadedFramePtr> frame = read(*reading);
    lock.lock();
    if (frame) {
      keep(*frame);
      // A view that moves faster than frames are read sees at least this one.
      if (reading->view && wanted_.contains(*reading->view) && wanted_[*reading->view].key(0) != reading->key)
        tellReady(*reading->view, *frame);
    } else {
      failures_[reading->key] = {frame.message(), std::chrono::steady_clock::now()};
    }
    tellReady();
    // The shared pool calls back, so it is called without the lock.
    const std::shared_ptr<SeriesPool> shared = shared_;
    lock.unlock();
    if (shared) shared->fit();
    lock.lock();
  }
}

// Requires the lock.
void FrameService::keep(const LoadedFramePtr& frame) {
  frameBytes_ = std::max<std::size_t>(1, frame->bytes());
  pool_.put(frame);
  QMetaObject::invokeMethod(
      this, [this, series = frame->key.series] { Q_EMIT held(series); }, Qt::QueuedConnection);
}

Result<Presentation> FrameService::presentationOf(const std::string& path) {
  if (const auto known = presentations_.find(path); known != presentations_.end()) return known->second;
  Result<Presentation> read = loadPresentation(path);
  if (read) presentations_.emplace(path, *read);
  return read;
}

Result<LoadedFramePtr> FrameService::read(const Reading& reading) {
  if (reading.key.presentation.empty()) return readAcquired(reading, {});
  const Result<Presentation> presentation = presentationOf(reading.key.presentation);
  if (!presentation) return readAcquired(reading, presentation.message());
  if (!namesPicture(presentation->pictures, *reading.series, reading.key.index))
    return readAcquired(reading, {});
  Result<PresentedFrame> shown = loadFrame(*reading.series, reading.key.index, *presentation);
  if (!shown) return readAcquired(reading, shown.message());
  std::vector<std::string>& warnings = shown->frame.warnings;
  warnings.insert(warnings.end(), presentation->warnings.begin(), presentation->warnings.end());
  return shownFrame(*reading.series, reading.key, std::move(shown->frame), std::move(shown->how));
}

// `warning` says why the frame is not shown otherwise; it is empty if it should not be.
Result<LoadedFramePtr> FrameService::readAcquired(const Reading& reading, const std::string& warning) {
  Result<Frame> frame = loadFrame(*reading.series, reading.key.index);
  if (!frame) return frame.error();
  if (!warning.empty()) frame->warnings.push_back(warning);
  const Series& series = *reading.series;
  const int index = reading.key.index;
  if (frame->greys.empty() || frameCount(series) < 2)
    return shownFrame(series, reading.key, *std::move(frame));
  setOwnWindow(series, index, *frame);
  std::vector<NamedGrey> greys = middleGreys(series, index, *frame);
  return shownFrame(series, reading.key, *std::move(frame), {}, std::move(greys));
}

void FrameService::setOwnWindow(const Series& series, int index, Frame& frame) {
  if (!frame.greys.empty() && frame.greys.front().ofValues)
    frame.greys.front().mapping.window = windowOf(series, index, frame);
}

// Returns none if the middle frame cannot be read or is in colour. `frame` is the one of `index`. A middle
// frame that was read for this is kept: it may be requested next.
std::vector<NamedGrey> FrameService::middleGreys(const Series& series, int index, const Frame& frame) {
  const FrameKey key{keyOf(series), frameCount(series) / 2};
  const auto known = middleGreys_.find(key.series);
  if (known != middleGreys_.end()) return known->second;
  if (key.index == index) return middleGreys_[key.series] = frame.greys;
  Result<Frame> middle = loadFrame(series, key.index);
  if (!middle) return {};
  setOwnWindow(series, key.index, *middle);
  const std::vector<NamedGrey> greys = middle->greys;
  if (const auto shown = shownFrame(series, key, *std::move(middle), {}, greys)) {
    const std::lock_guard lock(mutex_);
    keep(*shown);
  }
  return middleGreys_[key.series] = greys;
}

Window FrameService::windowOf(const Series& series, int index, const Frame& frame) {
  const auto [first, last] = framesOfOneWindow(series, index);
  if (first == last) return frame.greys.front().mapping.window;
  const auto known = windows_.find({keyOf(series), first});
  if (known != windows_.end()) return known->second;
  const int sampled = std::min(last - first + 1, sampledFrames);
  SharedWindow shared;
  bool isAnyRead = false;
  for (int n = 0; n < sampled; ++n) {
    const Result<Frame> sample =
        loadFrame(series, first + int(std::int64_t(n) * (last - first) / std::max(1, sampled - 1)));
    if (!sample) continue;
    isAnyRead = true;
    shared.add(sample->values, sample->padding);
  }
  const Window window = shared.window();
  if (isAnyRead) windows_[{keyOf(series), first}] = window;
  return window;
}

}  // namespace volumen
