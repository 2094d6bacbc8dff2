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

class MeasureJobs;

/// A picture of a flat view that was made.
struct MadePicture {
  QImage image;                      ///< RGB32, device pixel ratio 1
  Overlays overlays;                 ///< what the view says, over the picture or not
  QStringList warnings;              ///< what is not as it seems in it, whole sentences
  std::optional<double> mmPerPixel;  ///< of the image; none: it is not calibrated
  QString lengthsWord;               ///< what is true of its mm, where they are not the patient's
};

/// Has a stop hold what a session has now: the series in memory, and the preferences.
PictureStop heldNow(PictureStop stop, const Session& session);

/// Makes pictures of flat views one after the other, each of a workspace of its own, whatever is on screen
/// meanwhile: a job with progress. Frames are read and pictures drawn on other threads.
class PictureRun : public QObject {
  Q_OBJECT
 public:
  /// What becomes of picture `n`, on another thread. An Error ends the run.
  using Keep = std::function<Status(std::size_t n, const MadePicture& picture)>;
  /// After the last one, there too; the user cannot cancel it.
  using Finish = std::function<Status()>;

  /// Slices are those that the stops hold, or that `session` has in memory once it is their turn.
  PictureRun(const ViewGrid& grid, const Session& session, Jobs& jobs, const QString& doing,
             std::vector<PictureStop> stops, const PictureLook& look, QObject* parent = nullptr);
  ~PictureRun() override;

  /// Ends in ended(), once. What was not finished by then is the business of what `keep` and `finish` hold:
  /// both are gone when the run is.
  void start(Keep keep, Finish finish = {});
  bool hasEnded() const { return hasEnded_; }

 Q_SIGNALS:
  /// Empty: all pictures were made and kept. The run deletes itself.
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
  std::unique_ptr<Session> copy_;  // as the stop has it
  std::unique_ptr<MeasureJobs> measurer_;
  std::unique_ptr<FlatView> view_;  // over both
  QTimer numbersSoon_;
  bool isPrepared_ = false;  // what the stop shows is known
  bool hasEnded_ = false;
  JobLane lane_;
};

}  // namespace volumen
