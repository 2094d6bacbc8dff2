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

/// What a job does ("Opening"), and the file, folder or series that it does it to: not told while names are
/// hidden, and shortened where it is long.
struct JobName {
  JobName() = default;
  JobName(const QString& doing, const QString& object = {});

  QString text() const;

  QString doing, object;
};

/// What is told of a job that runs or waits.
struct JobRow {
  int id = 0;
  QString text;        ///< its name, and how far it is
  double part = -1;    ///< 0 to 1; negative: not known
  qint64 sinceMs = 0;  ///< since it was asked for
  bool canBeCancelled = true;
};

/// Work that takes its time: how far it is, told from any thread, and whether it was given up. Copies share
/// one state.
class Job {
 public:
  explicit Job(const JobName& name);

  /// Of all jobs of a run of the program.
  int id() const;
  const JobName& name() const;
  const CancelToken& cancel() const;
  bool cancelled() const { return cancel().cancelled(); }
  /// Whoever runs it begins; false where it was given up before.
  bool begin() const;
  bool hasBegun() const;

  /// `text` stands in place of the name; behind it where that has an object.
  void tell(const QString& text, double part) const;
  /// The same for what reads and writes files: "reading slices: 3 of 10".
  Progress progress() const;
  JobRow row() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// The list of the jobs that run and wait, in the order in which they were asked for. Whoever runs one
/// (JobLane does) puts it here and takes it away; each is cancelled for itself. Lives on one thread.
class Jobs : public QObject {
  Q_OBJECT
 public:
  explicit Jobs(QObject* parent = nullptr);

  /// `cancelled` is called once where the user cancels the job, after it has left the list. What is being
  /// written is written to its end: it cannot be cancelled.
  void add(const Job& job, std::function<void()> cancelled, bool canBeCancelled = true);
  /// It has ended; what is not in the list stays so.
  void remove(const Job& job);

  std::vector<JobRow> rows() const;
  /// As the user asks, where that can be.
  void cancel(int id);

 Q_SIGNALS:
  /// A job came, went or got further; every 100 ms while there are any.
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
