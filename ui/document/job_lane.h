#pragma once

#include <QThreadPool>
#include <concepts>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "ui/document/jobs.h"
#include "ui/document/no_memory.h"

namespace volumen {

/// Runs jobs one after the other on its own thread and delivers their results on the thread that made the
/// lane. Each job ends once, by calling `done`, unless it is cancelled.
class JobLane {
 public:
  /// Jobs with a name appear in `list`; without a list none does.
  explicit JobLane(Jobs* list = nullptr, QThread::Priority priority = QThread::InheritPriority);
  /// Cancels all jobs and waits for the running one.
  ~JobLane();
  JobLane(const JobLane&) = delete;
  JobLane& operator=(const JobLane&) = delete;

  /// Runs `work(job)` on the lane's thread, then `done(result)` on this one, or `done()` if work returns
  /// nothing. Long work checks job.cancelled() now and then. Once a job is cancelled neither is called. If
  /// the user cancelled it, `cancelled` is. If memory runs out, `done` gets an Error if the result can be
  /// one; otherwise the job is cancelled as if by the user. Returns the job's id.
  template <std::invocable<const Job&> Work, class Done>
  int run(const JobName& name, Work work, Done done, std::function<void()> cancelled = {}) {
    using Result = std::invoke_result_t<Work, const Job&>;
    const Job job = begin(name, cancelled);
    pool_.start([this, job, work = std::move(work), done = std::move(done), cancelled] {
      if (!job.begin()) return;
      if constexpr (std::constructible_from<Result, Error>) {
        deliver(job, done, orNoMemory([&] { return work(job); }));
      } else {
        try {
          if constexpr (std::is_void_v<Result>) {
            work(job);
            tell([this, job, done] { end(job, done); });
          } else {
            deliver(job, done, work(job));
          }
        } catch (const std::bad_alloc&) {
          tell([this, job, cancelled] {
            end(
                job, cancelled ? cancelled : [] {});
          });
        }
      }
    });
    return job.id();
  }

  /// For work: runs a function on the lane owner's thread unless the job is cancelled.
  template <std::invocable Function>
  void tell(const Job& job, Function function) {
    tell([job, function = std::move(function)] {
      if (!job.cancelled()) function();
    });
  }

  /// For work: runs a function on the lane owner's thread, even if the job is cancelled.
  template <std::invocable Function>
  void tell(Function function) {
    QMetaObject::invokeMethod(&here_, std::move(function), Qt::QueuedConnection);
  }

  /// Cancels a job silently. Does nothing if it has ended.
  void giveUp(int job);
  void giveUpAll();
  /// Cancels a job that has not begun.
  void giveUpWaiting(int job);
  bool isBusy() const { return !underWay_.empty(); }
  /// From now on the user cannot cancel its jobs: files are written to their end.
  void keepToTheEnd() { canBeCancelled_ = false; }
  /// Sets a function that the event loop calls whenever no jobs are left.
  void whenIdle(std::function<void()> idle) { idle_ = std::move(idle); }
  /// Waits until all jobs have been worked on.
  void wait() { pool_.waitForDone(); }

 private:
  Job begin(const JobName& name, std::function<void()> cancelled);
  void forget(const Job& job);

  template <class Done, class Result>
  void deliver(const Job& job, const Done& done, Result result) {
    const auto kept = std::make_shared<Result>(std::move(result));
    tell([this, job, done, kept] { end(job, [&] { done(std::move(*kept)); }); });
  }

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
