#pragma once

#include <QImage>
#include <QObject>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "ui/controller/draft.h"
#include "ui/session/quality_goal.h"
#include "viewer/render/render.h"

namespace volumen {

/// A picture and the plan it was drawn by.
struct Drawn {
  Picture picture;
  std::vector<float> error;  ///< Rendered::error
  Plan plan;
  RenderStats stats;
};

/// A plan that leaves nothing open, and what finding that took (completedPlan).
struct Planned {
  Plan plan;
  RenderStats stats;
};

/// Draws pictures of one volume; on the render thread only.
struct Draw {
  std::function<Result<Planned>(const Scene&, const RenderOptions&, const CancelToken&)> plan;
  std::function<Result<Drawn>(const Planned&, const CancelToken&)> picture;  ///< its times: of both

  /// Both at once.
  Result<Drawn> operator()(const Scene& scene, const RenderOptions& options, const CancelToken& cancel) const;
};
/// Makes what draws a volume, with its caches; called on the render thread.
using MakeDraw = std::function<Draw(VolumePtr)>;

/// makePlan(), completedPlan() and render() over one set of caches; OpenGL by a context of Qt's, else of
/// EGL's.
Draw drawWithCaches(VolumePtr volume);

/// A picture for the screen.
struct ScreenPicture {
  QImage image;  ///< as many pixels as were asked for
  Quality quality = Quality::standard;
  double factor = 1;    ///< one ray for factor x factor pixels (DraftPace, PictureLevel)
  bool atRest = false;  ///< no finer picture follows
  double ms = 0;  ///< wall clock up to the image, from the request taken or, at rest, from the moment that
                  ///< nothing new had been asked for long enough and drafts were done
  Scene scene;    ///< as drawn: with its camera
  std::shared_ptr<const Plan> plan;
  RenderStats stats;
  /// How far each pixel may be off (Rendered::error), and what that comes to; nothing where that is not
  /// known, as where the picture was enlarged.
  std::shared_ptr<const std::vector<float>> error;
  std::optional<PictureError> estimated;

  bool draft() const { return !atRest; }
};

/// A picture that was drawn to see what it takes.
struct Trial {
  int number = 0;  ///< that requestTrial() gave it
  PictureLevel level;
  QSize pixels;                        ///< of the full picture; `drawn` has fewer where level.edge > 1
  double ms = 0;                       ///< wall clock, up to the image, without what was made once
  std::shared_ptr<const Drawn> drawn;  ///< null: it failed
  QString failure;
};

/// Draws on a thread of its own: of what is asked for only the latest, first as a draft of fewer pixels
/// within the frame time, then at the level of pictures at rest once nothing new was asked for a moment, in
/// which that picture is planned. Where that one is expected to take long, a finer draft comes in between.
/// Asking never waits.
class RenderController : public QObject {
  Q_OBJECT
 public:
  explicit RenderController(MakeDraw makeDraw, QObject* parent = nullptr);
  /// Gives up what is being drawn and waits for the thread, which checks its token between rows.
  ~RenderController() override;

  /// What to draw from now on; null: nothing. No frame of the volume before is told any more.
  void setVolume(VolumePtr volume);
  /// Asks for a picture of so many device pixels; a scene without a camera is fitted to the picture.
  void request(const Scene& scene, QSize pixels);
  /// What resamples the full pictures asked for from now on (drafts are the CPU's). Where OpenGL fails,
  /// failed() says why and the CPU does it.
  void setResampler(Resampler resampler);
  /// The level of the full pictures asked for from now on.
  void setLevel(PictureLevel level);
  PictureLevel level() const { return level_; }
  /// Asks for a picture to be drawn and timed, as soon as there is nothing else to do; what comes meanwhile
  /// is drawn first. Ends in trialReady(). A second takes the place of the first.
  int requestTrial(const Scene& scene, QSize pixels, PictureLevel level);
  void dropTrial();
  /// Asks for a picture of a volume to be saved, whatever is on screen by then; they are drawn in order, when
  /// the screen has its picture. Each ends in pictureReady() with the number returned.
  int requestPicture(const VolumePtr& volume, const Scene& scene, const RenderOptions& options);
  /// Gives up all of them.
  void cancelPictures();
  /// How much of the picture to be saved is drawn, 0 to 1.
  double pictureDone() const;
  /// Asks for small pictures of these scenes, whole, after everything else; returns the number of the batch.
  /// Each ends in thumbnailReady() or, where it cannot be drawn, in nothing. A second takes the place of the
  /// first; none are left of a volume before.
  int requestThumbnails(std::vector<Scene> scenes, QSize pixels);

 Q_SIGNALS:
  void thumbnailReady(int batch, int n, const QImage& image);
  void screenPictureReady(const volumen::ScreenPicture& picture);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);
  void trialReady(const volumen::Trial& trial);
  /// `drawn` null: `failure` says why.
  void pictureReady(int number, const std::shared_ptr<volumen::Drawn>& drawn, const QString& failure);
  /// Whether the thread has something to do.
  void workingChanged(bool working);

 private:
  struct ScreenRequest {
    Scene scene;
    QSize pixels;
    Resampler resampler;
    PictureLevel level;
  };
  // One drawing of what a screen request shows.
  struct Pass {
    Quality quality;
    double factor;
    bool operator==(const Pass&) const = default;
  };
  // What a pass draws.
  struct View {
    Scene shown;  // with its camera
    Scene scene;  // of the draft's pixels
    RenderOptions options;
  };
  // What was planned while it was not known yet whether something new would be asked for.
  struct Ahead {
    Result<Planned> planned;
    std::chrono::steady_clock::time_point rest;  // from when on nothing was
  };
  struct Thumbnails {
    std::vector<Scene> scenes;
    QSize pixels;
    std::size_t next = 0;
  };
  struct PictureRequest {
    int number;
    VolumePtr volume;
    Scene scene;
    RenderOptions options;
    CancelToken cancel;
  };

  void run();
  bool waitForWork(std::unique_lock<std::mutex>& lock);
  void drawPicture(std::unique_lock<std::mutex>& lock);
  void drawScreen(std::unique_lock<std::mutex>& lock);
  void drawTrial(std::unique_lock<std::mutex>& lock);
  void drawThumbnail(std::unique_lock<std::mutex>& lock);
  Pass firstPass(PictureLevel rest) const;
  View viewOf(const ScreenRequest& request, Pass pass) const;
  bool drawBetween(const ScreenRequest& request, Pass first, std::unique_lock<std::mutex>& lock);
  bool drawFrame(const ScreenRequest& request, Pass pass, bool atRest, const CancelToken& cancel,
                 const Ahead* ahead = nullptr);
  Result<Drawn> drawPass(const ScreenRequest& request, Pass pass, ScreenPicture& frame,
                         const CancelToken& cancel, const Ahead* ahead = nullptr);
  Result<Drawn> draw(const Scene& scene, const RenderOptions& options, const CancelToken& cancel);
  template <class Function>
  void tell(Function function);

  const MakeDraw makeDraw_;

  mutable std::mutex mutex_;  // guards from here ...
  std::condition_variable wake_;
  VolumePtr volume_;
  int generation_ = 0;  // of the volume
  std::optional<ScreenRequest> screen_;
  std::deque<PictureRequest> pictures_;
  int pictureNumber_ = 0;
  std::optional<ScreenRequest> trial_;
  int trialNumber_ = 0;
  std::optional<Thumbnails> thumbnails_;
  int thumbnailBatch_ = 0;
  CancelToken volumeCancel_, restCancel_, trialCancel_;  // the last of thumbnails, too
  CancelToken pictureCancel_;                            // of the picture being drawn
  Resampler resampler_ = Resampler::cpu;
  PictureLevel level_;
  bool closing_ = false;  // ... to here

  // Of the render thread alone.
  VolumePtr drawnVolume_;
  int drawnGeneration_ = 0;
  std::optional<Draw> draw_;
  DraftPace pace_;
  RestCost cost_;
  std::optional<ScreenRequest> seen_;  // what is on screen, if only as a draft

  std::thread thread_;
};

}  // namespace volumen
