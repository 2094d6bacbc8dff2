#pragma once

#include <QObject>
#include <QThreadPool>
#include <map>
#include <memory>
#include <mutex>

#include "ui/workspace/session.h"
#include "viewer/measure/measure.h"

namespace volumen {

using MeasuredPtr = std::shared_ptr<const Result<Measured>>;

/// What measurements come to. What takes no time is measured at once, the rest on a worker thread: of each
/// measurement the latest shape, so that a drag never waits.
class Measurer : public QObject {
  Q_OBJECT
 public:
  explicit Measurer(const Session& session, QObject* parent = nullptr);
  ~Measurer() override;

  /// The latest numbers of a measurement; null: none yet. Those of its shape are asked for where they are
  /// missing and its series is in memory.
  MeasuredPtr numbersOf(const Measurement& measurement);
  /// Likewise, but null where they are of another shape.
  MeasuredPtr exactNumbersOf(const Measurement& measurement);

 Q_SIGNALS:
  /// Numbers that were asked for are there.
  void measured();

 private:
  struct Job {
    int id = 0, number = 0;
    Shape shape;
    VolumePtr volume;
    std::string unit;
  };
  struct Known {
    SeriesKey series;
    Shape shape;
    Mask mask;  // of the series then
    std::weak_ptr<const Volume> volume;
    int asked = 0, shown = 0;  // numbers of jobs
    MeasuredPtr numbers;
  };
  void request(const Measurement& measurement, const ShownSeriesPtr& series);
  void runNext();
  void take(const Job& job, Result<Measured> result);

  const Session& session_;
  std::map<int, Known> known_;
  int jobs_ = 0;
  CancelToken closing_;
  std::mutex mutex_;          // guards what follows
  std::vector<Job> waiting_;  // one a measurement
  QThreadPool pool_;
};

}  // namespace volumen
