#include "ui/controller/file_jobs.h"

namespace volumen {

FileJobs::FileJobs(Jobs& jobs, QObject* parent) : QObject(parent), open_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

FileJobs::~FileJobs() { save_.wait(); }

void FileJobs::save(const QString& doing, std::function<Status()> write, std::function<void()> done) {
  save_.run(
      doing, [write = std::move(write)](const Job&) { return write(); },
      [this, done = std::move(done)](const Status& status) {
        if (status)
          done();
        else
          tellFailed(status.message());
      });
}

}  // namespace volumen
