#pragma once

#include <QObject>
#include <QThreadPool>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "ui/controller/frame_service.h"
#include "ui/workspace/session.h"
#include "viewer/measure/measure.h"

namespace volumen {

using MeasuredPtr = std::shared_ptr<const Result<Measured>>;

/// What measurements come to. What takes no time is measured at once, the rest on a worker thread: of each
/// measurement the latest shape, so that a drag never waits.
class Measurer : public QObject {
  Q_OBJECT
 public:
  Measurer(const Session& session, FrameService& frames, QObject* parent = nullptr);
  ~Measurer() override;

  /// The latest numbers of a measurement; null: none yet. Those of its shape are asked for where they are
  /// missing and its series is in memory; frames are read for it.
  MeasuredPtr numbersOf(const Measurement& measurement);
  /// Likewise, but null where they are of another shape.
  MeasuredPtr exactNumbersOf(const Measurement& measurement);

 Q_SIGNALS:
  /// Numbers that were asked for are there.
  void measured();

 private:
  struct Job {
    int id = 0, number = 0;
    std::function<Result<Measured>(const CancelToken&)> measure;
  };
  struct Known {
    SeriesKey series;
    Shape shape;
    Mask mask;  // of the series then
    PetUnit petUnit = PetUnit::file;
    std::weak_ptr<const Volume> volume;
    int asked = 0, shown = 0;  // numbers of jobs
    MeasuredPtr numbers;
  };
  void request(const Measurement& measurement, const ShownSeriesPtr& series);
  void requestOnFrame(const Measurement& measurement);
  Known& begin(const Measurement& measurement);
  void start(Job job, double steps);
  void endRead(int view);
  void runNext();
  void take(const Job& job, Result<Measured> result);

  const Session& session_;
  FrameService& frames_;
  std::optional<FrameKey> read_;            // the frame that is being read to be measured on
  std::map<FrameKey, std::string> unread_;  // why frames cannot be
  std::map<int, Known> known_;
  int jobs_ = 0;
  CancelToken closing_;
  std::mutex mutex_;          // guards what follows
  std::vector<Job> waiting_;  // one a measurement
  QThreadPool pool_;
};

}  // namespace volumen
