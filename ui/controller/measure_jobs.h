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

/// What measurements come to. What takes no time is measured at once, the rest on a worker thread: of each
/// measurement the latest shape, so that a drag never waits. Regions of a series that another one is shown
/// over have the numbers of both.
class MeasureJobs : public QObject {
  Q_OBJECT
 public:
  MeasureJobs(const Session& session, FrameService& frames, QObject* parent = nullptr);

  /// The latest numbers of a measurement; null: none yet. Those of its shape are asked for where they are
  /// missing and its series is in memory; frames are read for it.
  MeasuredPtr numbersOf(const Measurement& measurement);
  /// Likewise, but null where they are of another shape.
  MeasuredPtr exactNumbersOf(const Measurement& measurement);

 Q_SIGNALS:
  /// Numbers that were asked for are there.
  void measured();

 private:
  using Measure = std::function<Result<Measured>(const CancelToken&)>;
  // Two series that a region was measured on; null: it was one.
  struct Both {
    std::shared_ptr<const Series> under, over;
  };
  struct Known {
    SeriesKey series;
    Shape shape;
    Mask mask;  // of the series then
    PetUnit petUnit = PetUnit::file;
    std::weak_ptr<const Volume> volume;
    std::optional<SeriesOver> over;
    std::weak_ptr<const Volume> overVolume;
    int asked = 0, shown = 0;  // which of all that were asked for
    int job = 0;
    MeasuredPtr numbers;
    Both both;                 // of `numbers`
    bool namesHidden = false;  // in `numbers`
  };
  // What lies over a region's series, as far as it is in memory.
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
  // Why a frame cannot be measured on, and when that was found.
  struct Unread {
    std::string why;
    std::chrono::steady_clock::time_point at;
  };
  std::optional<FrameKey> read_;       // the frame that is being read to be measured on
  std::map<FrameKey, Unread> unread_;  // until frames of the series can be read again
  std::map<int, Known> known_;
  int asked_ = 0;
  JobLane lane_;
};

}  // namespace volumen
