#pragma once

#include <functional>
#include <utility>

#include "ui/document/job_lane.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Reads and writes files of one kind, each as a job. Of several files being opened only the latest counts.
class FileJobs : public QObject {
  Q_OBJECT
 public:
  explicit FileJobs(Jobs& jobs, QObject* parent = nullptr);
  /// Waits until pending files are written.
  ~FileJobs() override;

  /// Runs `read` on the job's thread. Ends in taken(value) of its Result, or in failed().
  template <class Read, class Taken>
  void open(const QString& doing, Read read, Taken taken) {
    open_.run(
        doing, [read = std::move(read)](const Job&) { return read(); },
        [this, taken = std::move(taken)](const auto& value) {
          if (value)
            taken(*value);
          else
            tellFailed(value.message());
        });
  }
  /// Runs `write` on the job's thread. Ends in done(), or in failed().
  void save(const QString& doing, std::function<Status()> write, std::function<void()> done);

 Q_SIGNALS:
  /// A sentence that names the file.
  void failed(const QString& sentence);

 private:
  void tellFailed(const std::string& sentence) { Q_EMIT failed(QString::fromStdString(sentence)); }

  JobLane open_, save_;
};

}  // namespace volumen
