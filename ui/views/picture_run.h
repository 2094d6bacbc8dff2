#pragma once

#include <QImage>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ui/controller/frame_service.h"
#include "ui/document/job_lane.h"
#include "ui/overlays/overlays.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/picture_look.h"
#include "ui/workspace/session.h"

namespace volumen {

class MeasuredNumbers;

/// A finished picture of a flat view.
struct MadePicture {
  QImage image;                      ///< RGB32, device pixel ratio 1
  Overlays overlays;                 ///< texts of the view, drawn over the picture or not
  QStringList warnings;              ///< warnings about the picture, whole sentences
  std::optional<double> mmPerPixel;  ///< of the image; empty if it is not calibrated
  QString lengthsWord;               ///< what the mm refer to if not to the patient
};

/// Stores in a stop what a session has now: its series in memory and its preferences.
PictureStop heldNow(PictureStop stop, const Session& session);

/// Makes pictures of flat views one after another, as a job with progress. Each has its own workspace,
/// independent of what is on screen. Frames are read and pictures drawn on other threads.
class PictureRun : public QObject {
  Q_OBJECT
 public:
  /// Stores picture `n`, on another thread. An Error ends the run.
  using Keep = std::function<Status(std::size_t n, const MadePicture& picture)>;
  /// Runs after the last picture, on another thread. The user cannot cancel it.
  using Finish = std::function<Status()>;

  /// Slices come from the series that the stops hold, or that `session` has in memory at their turn.
  PictureRun(const ViewGrid& grid, const Session& session, Jobs& jobs, const QString& doing,
             std::vector<PictureStop> stops, const PictureLook& look, QObject* parent = nullptr);
  ~PictureRun() override;

  /// Starts the run, which emits ended() once. `keep` and `finish` are destroyed with the run, so what they
  /// hold must clean up unfinished output.
  void start(Keep keep, Finish finish = {});
  bool hasEnded() const { return hasEnded_; }

 Q_SIGNALS:
  /// The run is over and deletes itself. `failure` is empty if all pictures were made and stored.
  void ended(const QString& failure);

 private:
  using Size = PictureLook::Size;

  void next();
  void finish();
  void showStop();
  void prepare();
  void waitForNumbers();
  void draw();
  void keepPicture(QImage picture, double mmPerPixel);
  void take(const Status& kept);
  void end(const QString& failure);
  QSize pixelsWanted() const;
  void resizeView(QSize logical);
  void layOutForPaper();

  const ViewGrid& grid_;
  const ViewGrid::Shown shown_;
  const Session& session_;
  Jobs& jobs_;
  const Job job_;
  const std::vector<PictureStop> stops_;
  const PictureLook look_;
  Keep keep_;
  Finish finish_;
  std::size_t at_ = 0;
  FrameService frames_;
  std::unique_ptr<Session> copy_;  // with the workspace of the stop
  std::unique_ptr<MeasuredNumbers> measurer_;
  std::unique_ptr<FlatView> view_;  // over copy_ and measurer_
  QTimer numbersSoon_;
  bool isPrepared_ = false;  // whether the content of the stop is known
  bool hasEnded_ = false;
  JobLane lane_;
};

}  // namespace volumen
