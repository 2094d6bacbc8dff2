#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>

#include "ui/controller/frame_service.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/links.h"
#include "ui/workspace/session.h"
#include "viewer/measure/measure.h"

namespace volumen {

using MeasuredPtr = std::shared_ptr<const Result<Measured>>;

/// Computes the results of measurements. Fast measurements are made at once, others on a worker thread. Only
/// the latest shape of each measurement is measured, so that drags never wait. Regions have results of the
/// series and of a series overlaid on it.
class MeasureJobs : public QObject {
  Q_OBJECT
 public:
  MeasureJobs(const Session& session, FrameService& frames, QObject* parent = nullptr);

  /// Returns the latest results of a measurement, or null if there are none yet. Requests those of its
  /// present shape if they are missing and its series is in memory; frames are read for it.
  MeasuredPtr numbersOf(const Measurement& measurement);
  /// Returns the same, but null if the results belong to another shape.
  MeasuredPtr exactNumbersOf(const Measurement& measurement);

 Q_SIGNALS:
  /// Requested results are ready.
  void measured();

 private:
  using Measure = std::function<Result<Measured>(const CancelToken&)>;
  // The two series a region was measured on; null if it was one.
  struct Both {
    std::shared_ptr<const Series> under, over;
  };
  struct Known {
    SeriesKey series;
    Shape shape;
    Mask mask;  // of the series at that time
    PetUnit petUnit = PetUnit::file;
    std::weak_ptr<const Volume> volume;
    std::optional<SeriesOver> over;
    std::weak_ptr<const Volume> overVolume;
    int asked = 0, shown = 0;  // serial numbers of requests
    int job = 0;
    MeasuredPtr numbers;
    Both both;                 // series of `numbers`
    bool namesHidden = false;  // whether names were hidden in `numbers`
  };
  // The series overlaid on a region's series, if it is in memory.
  struct Over {
    std::optional<SeriesOver> place;
    LoadedSeriesPtr series;
  };
  Over overOf(const Measurement& measurement) const;
  void request(const Measurement& measurement, const LoadedSeriesPtr& series, const Over& over);
  void requestOnFrame(const Measurement& measurement);
  Known& begin(const Measurement& measurement);
  MeasuredPtr named(Known& known) const;
  void start(int id, const Measure& measure, double steps, const Both& both = {});
  void endRead(int view);
  void forgetUnread(const SeriesKey& series);
  void take(int id, int asked, Result<Measured> result, const Both& both = {});

  const Session& session_;
  FrameService& frames_;
  // Why a frame cannot be measured on, and since when.
  struct Unread {
    std::string why;
    std::chrono::steady_clock::time_point at;
  };
  std::optional<FrameKey> read_;       // the frame being read for a measurement
  std::map<FrameKey, Unread> unread_;  // until frames of the series can be read again
  std::map<int, Known> known_;
  int asked_ = 0;
  JobLane lane_;
};

}  // namespace volumen
