#pragma once

#include <QThreadPool>
#include <concepts>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "ui/document/jobs.h"

namespace volumen {

/// Runs jobs one after the other on a thread of its own, and brings what they come to back to the thread that
/// it was made on. Each job that is not given up ends once, in what `done` does.
class JobLane {
 public:
  /// Jobs with a name stand in the list; without one none does.
  explicit JobLane(Jobs* list = nullptr, QThread::Priority priority = QThread::InheritPriority);
  /// Gives up all and waits for the one that runs.
  ~JobLane();
  JobLane(const JobLane&) = delete;
  JobLane& operator=(const JobLane&) = delete;

  /// `work(job)` on the lane's thread, where it may be long and asks job.cancelled() now and then; then
  /// `done(result)` here, or `done()` where work returns nothing. Neither is called once the job was given
  /// up; where the user did so, `cancelled` is. Returns the job's number.
  template <std::invocable<const Job&> Work, class Done>
  int run(const JobName& name, Work work, Done done, std::function<void()> cancelled = {}) {
    using Result = std::invoke_result_t<Work, const Job&>;
    const Job job = begin(name, std::move(cancelled));
    pool_.start([this, job, work = std::move(work), done = std::move(done)] {
      if (!job.begin()) return;
      if constexpr (std::is_void_v<Result>) {
        work(job);
        tell([this, job, done] { end(job, done); });
      } else {
        const auto result = std::make_shared<Result>(work(job));
        tell([this, job, done, result] { end(job, [&] { done(std::move(*result)); }); });
      }
    });
    return job.id();
  }

  /// For work: runs a function here, as long as the job is not given up.
  template <std::invocable Function>
  void tell(const Job& job, Function function) {
    tell([job, function = std::move(function)] {
      if (!job.cancelled()) function();
    });
  }

  /// For work: runs a function here, whatever becomes of the job.
  template <std::invocable Function>
  void tell(Function function) {
    QMetaObject::invokeMethod(&here_, std::move(function), Qt::QueuedConnection);
  }

  /// Without a word; what has ended stays so.
  void giveUp(int job);
  void giveUpAll();
  /// Where it only waits as yet.
  void giveUpWaiting(int job);
  bool isBusy() const { return !underWay_.empty(); }
  /// From now on its jobs cannot be cancelled by the user: what is written is written to its end.
  void keepToTheEnd() { canBeCancelled_ = false; }
  /// Called, from the event loop, whenever nothing is asked for any more.
  void whenIdle(std::function<void()> idle) { idle_ = std::move(idle); }
  /// Until all that was asked for has been worked on.
  void wait() { pool_.waitForDone(); }

 private:
  Job begin(const JobName& name, std::function<void()> cancelled);
  void forget(const Job& job);

  template <class Done>
  void end(const Job& job, const Done& done) {
    if (job.cancelled()) return;
    forget(job);
    done();
  }

  Jobs* list_;
  QObject here_;
  std::unordered_map<int, Job> underWay_;
  std::function<void()> idle_;
  bool canBeCancelled_ = true;
  QThreadPool pool_;
};

}  // namespace volumen
