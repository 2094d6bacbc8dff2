#pragma once

#include <QObject>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "io/presentation.h"
#include "io/study/progress.h"
#include "ui/data/frame_pool.h"
#include "ui/data/series_pool.h"
#include "ui/workspace/view_id.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Reads and decodes frames on threads of its own: first the frame each view wants, those of several views at
/// once, then one by one the next ones in their directions. No call of a view waits.
///
/// Frames of a series whose files have no window share one. Series that areMadeOneByOne() have one per file.
/// It is that of windowOfFrames().
class FrameService : public QObject {
  Q_OBJECT
 public:
  /// Time before a frame that could not be read is tried again, ms.
  static constexpr int tryAgainMs = 1000;

  explicit FrameService(std::size_t budget = defaultBudget(), QObject* parent = nullptr);
  ~FrameService() override;

  /// Returns a frame in memory, or null.
  LoadedFramePtr find(const FrameKey& key);
  /// Returns FramePool::heldOf().
  std::vector<int> heldOf(const SeriesKey& series, const std::string& presentation);
  /// Requests a frame. Ends in ready() or failed(), unless the view requests another one before it is begun.
  /// Failed frames are retried after tryAgainMs. `step` is 1 or -1, the direction of the next frames.
  /// `presentation` is the file of a presentation state. Frames that it does not refer to, or cannot apply
  /// to, are shown as acquired.
  void request(ViewId view, std::shared_ptr<const Series> series, int index, int step,
               const std::string& presentation = {});
  /// Returns a frame, read on the calling thread if it is not in memory, after those that views wait for.
  Result<LoadedFramePtr> readNow(const std::shared_ptr<const Series>& series, int index,
                                 const CancelToken& cancel);
  /// Blocks until no view waits for a frame or `cancel` is set. Threads whose reading is less urgent call it.
  void waitForViews(const CancelToken& cancel);
  /// Stops reading ahead for a view.
  void drop(ViewId view);

  /// Returns 6 % of the memory of the machine, at most 1 GiB.
  static std::size_t defaultBudget();
  /// Sets how many bytes of frames are kept, including those on screen.
  void setBudget(std::size_t bytes);
  /// Counts the frames in the budget of `pool`, which drops them after everything else.
  void shareBudgetOf(std::shared_ptr<SeriesPool> pool);

 Q_SIGNALS:
  /// The frame that a view wants, or wanted when reading began.
  void ready(int view, const volumen::LoadedFramePtr& frame);
  void failed(int view, const volumen::FrameKey& key, const QString& sentence);
  /// A percent more of a large frame was read. Not sent for frames that are read ahead.
  void progressed(const volumen::FrameKey& key, int percent);
  /// Another frame of this series is in memory.
  void held(const volumen::SeriesKey& series);

 private:
  struct Wanted {
    std::shared_ptr<const Series> series;
    int index = 0, step = 1;
    std::string presentation;
    bool told = false;
    int passed = 0;  // Frames, counted from its own, that were read or need not be

    FrameKey key(int ahead) const { return {keyOf(*series), index + ahead * step, presentation}; }
  };
  struct Failure {
    std::string sentence;
    std::chrono::steady_clock::time_point at;
  };
  struct Reading {
    std::shared_ptr<const Series> series;
    FrameKey key;
    std::optional<ViewId> view = {};  // the view that wants it
    bool isAhead = false;
  };

  void run();
  void end(const Reading& reading, const Result<LoadedFramePtr>& frame);
  void tellReady();
  void tellReady(ViewId view, const LoadedFramePtr& frame);
  std::optional<Reading> nextReading();
  std::optional<Reading> nextMiddle() const;
  std::optional<Reading> nextOf(int ahead);
  int reach() const;
  bool isKnown(const FrameKey& key) const { return pool_.contains(key) || failures_.contains(key); }
  bool isUnderWay(const FrameKey& key) const;
  Progress progressOf(const Reading& reading);
  Result<LoadedFramePtr> readHere(std::unique_lock<std::mutex>& lock, const Reading& reading);
  Result<LoadedFramePtr> read(const Reading& reading);
  Result<LoadedFramePtr> readAcquired(const Reading& reading, const std::string& warning);
  Result<Presentation> presentationOf(const std::string& path);
  void keep(const LoadedFramePtr& frame);
  Window windowOf(const Series& series, int index, const Frame& frame);
  void setOwnWindow(const Series& series, int index, Frame& frame);
  std::vector<NamedGrey> middleGreys(const Reading& reading, const Frame& frame);

  std::mutex sharedMutex_;  // guards the next two, also while they are read; never taken within mutex_
  // Windows of frames without one, by the first frame that shares it.
  std::map<std::pair<SeriesKey, int>, Window> windows_;
  std::map<std::string, Presentation> presentations_;  // by file
  std::mutex mutex_;                                   // guards from here ...
  std::condition_variable wake_;
  FramePool pool_;
  std::shared_ptr<SeriesPool> shared_;  // may be null
  std::map<ViewId, Wanted> wanted_;
  std::map<FrameKey, Failure> failures_;
  std::map<SeriesKey, std::vector<NamedGrey>> middleGreys_;
  std::vector<Reading> underWay_;
  std::size_t frameBytes_ = 1;  // size of the frame read last
  bool closing_ = false;        // ... to here
  std::vector<std::thread> threads_;
};

}  // namespace volumen
