#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Action of a job ("Opening") and the file, folder or series it acts on. The object is hidden while names
/// are hidden, and shortened if it is long.
struct JobName {
  JobName() = default;
  JobName(const QString& doing, const QString& object = {});

  QString text() const;

  QString doing, object;
};

/// A running or waiting job as it is listed.
struct JobRow {
  int id = 0;
  QString text;        ///< name and progress
  double part = -1;    ///< progress from 0 to 1; negative: unknown
  qint64 sinceMs = 0;  ///< time since the job was requested
  bool canBeCancelled = true;
};

/// A long-running task with progress, reported from any thread, and cancellation. Copies share one state.
class Job {
 public:
  explicit Job(const JobName& name);

  /// Returns an id that is unique in this run of the program.
  int id() const;
  const JobName& name() const;
  const CancelToken& cancel() const;
  bool cancelled() const { return cancel().cancelled(); }
  /// Called by whoever runs the job. Returns false if it was cancelled before.
  bool begin() const;
  bool hasBegun() const;

  /// Reports progress. `text` replaces the name, or follows it if the name has an object.
  void tell(const QString& text, double part) const;
  /// Returns a progress function for reading and writing files: "reading slices: 3 of 10".
  Progress progress() const;
  JobRow row() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// The list of running and waiting jobs, in the order of their requests. Whoever runs a job (such as JobLane)
/// adds and removes it; each is cancelled separately. Lives on one thread.
class Jobs : public QObject {
  Q_OBJECT
 public:
  explicit Jobs(QObject* parent = nullptr);

  /// Adds a job. `cancelled` is called once if the user cancels it, after it has left the list. Jobs that
  /// write files cannot be cancelled: they are written to their end.
  void add(const Job& job, std::function<void()> cancelled, bool canBeCancelled = true);
  /// Removes a job that has ended. Does nothing if it is not listed.
  void remove(const Job& job);

  std::vector<JobRow> rows() const;
  /// Cancels a job for the user, if that is allowed.
  void cancel(int id);

 Q_SIGNALS:
  /// Emitted when a job is added, removed or makes progress; every 100 ms while there are jobs.
  void changed();

 private:
  struct Listed {
    Job job;
    std::function<void()> cancelled;
    bool canBeCancelled;
  };
  std::vector<Listed>::iterator find(int id);

  std::vector<Listed> listed_;
  QTimer tick_;
};

}  // namespace volumen
