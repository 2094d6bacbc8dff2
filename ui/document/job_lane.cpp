#include "ui/document/job_lane.h"

#include <utility>

namespace volumen {

JobLane::JobLane(Jobs* list, QThread::Priority priority) : list_(list) {
  pool_.setMaxThreadCount(1);
  pool_.setExpiryTimeout(-1);  // one permanent thread: objects bound to a thread may stay
  pool_.setThreadPriority(priority);
}

JobLane::~JobLane() {
  giveUpAll();
  wait();
}

Job JobLane::begin(const JobName& name, std::function<void()> cancelled) {
  const Job job(name);
  underWay_.emplace(job.id(), job);
  if (list_ && !name.doing.isEmpty())
    list_->add(
        job,
        [this, job, cancelled = std::move(cancelled)] {
          forget(job);
          if (cancelled) cancelled();
        },
        canBeCancelled_);
  return job;
}

void JobLane::forget(const Job& job) {
  underWay_.erase(job.id());
  if (list_) list_->remove(job);
  if (underWay_.empty() && idle_)
    tell([this] {
      if (!isBusy()) idle_();
    });
}

void JobLane::giveUp(int job) {
  const auto at = underWay_.find(job);
  if (at == underWay_.end()) return;
  const Job given = at->second;
  given.cancel().cancel();
  forget(given);
}

void JobLane::giveUpWaiting(int job) {
  const auto at = underWay_.find(job);
  if (at != underWay_.end() && !at->second.hasBegun()) giveUp(job);
}

void JobLane::giveUpAll() {
  while (!underWay_.empty()) giveUp(underWay_.begin()->first);
}

}  // namespace volumen
