#pragma once

#include <QObject>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "io/presentation.h"
#include "ui/data/frame_pool.h"
#include "ui/workspace/view_id.h"

namespace volumen {

/// Reads and decodes frames on a thread of its own: of each view the one that is wanted, then those that come
/// next in the direction in which it goes. Asking never waits.
///
/// Where files have no window, all frames of a series share one, of pictures that areMadeOneByOne() all of a
/// file: P0.1 .. P99.9 of at most `sampledFrames` of them, evenly placed.
class FrameService : public QObject {
  Q_OBJECT
 public:
  static constexpr int sampledFrames = 9;
  /// How long a frame that could not be read is not read again, ms.
  static constexpr int tryAgainMs = 1000;

  explicit FrameService(std::size_t budget = defaultBudget(), QObject* parent = nullptr);
  ~FrameService() override;

  /// A frame that is in memory; else null.
  LoadedFramePtr find(const FrameKey& key);
  /// FramePool::heldOf().
  std::vector<int> heldOf(const SeriesKey& series, const std::string& presentation);
  /// Ends in ready() or failed(), unless the view asks for another one before it is begun. What failed is
  /// tried again after a while (tryAgainMs). `step`: 1 or -1,
  /// where the next ones lie. `presentation`: the file of a presentation state; frames that it does not name,
  /// or that it cannot be applied to, are shown as acquired.
  void request(ViewId view, std::shared_ptr<const Series> series, int index, int step,
               const std::string& presentation = {});
  /// Reads nothing ahead for a view any more.
  void drop(ViewId view);

  /// 1/16 of the machine's memory, at most 1 GiB.
  static std::size_t defaultBudget();

 Q_SIGNALS:
  /// What a view wants, or wanted when it was begun.
  void ready(int view, const volumen::LoadedFramePtr& frame);
  void failed(int view, const volumen::FrameKey& key, const QString& sentence);
  /// Another frame of this series is in memory.
  void held(const volumen::SeriesKey& series);

 private:
  struct Wanted {
    std::shared_ptr<const Series> series;
    int index = 0, step = 1;
    std::string presentation;
    bool told = false;

    FrameKey key(int ahead) const { return {keyOf(*series), index + ahead * step, presentation}; }
  };
  struct Failure {
    std::string sentence;
    std::chrono::steady_clock::time_point at;
  };
  struct Reading {
    std::shared_ptr<const Series> series;
    FrameKey key;
    std::optional<ViewId> view;  // that wants it; none: read ahead
  };

  void run();
  void tellReady();
  void tellReady(ViewId view, const LoadedFramePtr& frame);
  std::optional<Reading> nextReading() const;
  int reach() const;
  bool isKnown(const FrameKey& key) const { return pool_.contains(key) || failures_.contains(key); }
  Result<LoadedFramePtr> read(const Reading& reading);
  Result<LoadedFramePtr> readAcquired(const Reading& reading, const std::string& warning);
  Result<Presentation> presentationOf(const std::string& path);
  Window windowOf(const Series& series, int index);
  std::vector<NamedGrey> middleGreys(const Series& series);

  // Of frames without one, by the first that share it; of the thread alone, as the next two.
  std::map<std::pair<SeriesKey, int>, Window> windows_;
  std::map<SeriesKey, std::vector<NamedGrey>> middleGreys_;
  std::map<std::string, Presentation> presentations_;  // by file
  std::mutex mutex_;                                   // guards from here ...
  std::condition_variable wake_;
  FramePool pool_;
  std::map<ViewId, Wanted> wanted_;
  std::map<FrameKey, Failure> failures_;
  std::size_t frameBytes_ = 1;  // of the frame read last
  bool closing_ = false;        // ... to here
  std::thread thread_;
};

}  // namespace volumen
