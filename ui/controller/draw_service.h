#pragma once

#include <QObject>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "ui/controller/draw_schedule.h"
#include "ui/controller/view_drawing.h"
#include "ui/data/series_pool.h"

namespace volumen {

/// The end of a request for the screen.
enum class Answer {
  drawn,     ///< its picture at rest is on screen
  replaced,  ///< another request was made for the view
  /// The view is hidden or shows another volume, the picture has no pixels, or the service closes.
  cancelled,
  failed  ///< failed() has reported the reason
};

/// A picture drawn to measure its time.
struct Trial {
  int number = 0;  ///< as returned by requestTrial()
  PictureLevel level;
  QSize pixels;                        ///< of the full picture; `drawn` has fewer if level.edge > 1
  double ms = 0;                       ///< wall-clock time until the image, without work done once per volume
  std::shared_ptr<const Drawn> drawn;  ///< null if it failed
  QString failure;
};

/// Draws the 3D pictures of all views on its own thread, in the order of nextTurn(). Each view has only its
/// latest request. First a draft with fewer pixels is drawn within the frame time. After a short pause
/// without new requests, in which the picture at rest is planned, that is drawn at its level. If it is
/// expected to take long, a finer draft precedes it. Views of one volume share precomputed
/// data. No call waits. All functions belong to the thread of this object. Signals come from its event loop;
/// only the last answers come from the destructor.
class DrawService : public QObject {
  Q_OBJECT
 public:
  /// `pool` holds what is computed of volumes.
  explicit DrawService(MakeDraw makeDraw, std::shared_ptr<SeriesPool> pool = std::make_shared<SeriesPool>(),
                       QObject* parent = nullptr);
  /// Cancels the current picture and waits for the thread, which checks its token between rows. Open requests
  /// are answered with `cancelled`.
  ~DrawService() override;

  /// Sets the volume a view shows; null hides the view and draws nothing. Pictures of the volume shown before
  /// are no longer reported.
  void show(ViewId view, VolumePtr volume);
  /// Requests a picture of `pixels` device pixels. A scene without a camera is fitted to the picture. Returns
  /// a number, larger than all before, that is answered exactly once.
  int request(ViewId view, const Scene& scene, QSize pixels);
  /// Sets the view of the last gesture, which takes precedence.
  void setGestureView(ViewId view);
  /// Sets the resampler of full pictures requested from now on; drafts use the CPU. If OpenGL fails, failed()
  /// says why and the CPU takes over.
  void setResampler(Resampler resampler);
  /// Sets whether pictures requested from now on estimate the error of each pixel where possible.
  void setErrorWanted(bool wanted);
  /// Sets the level of full pictures requested from now on.
  void setLevel(ViewId view, PictureLevel level);
  PictureLevel level(ViewId view) const;
  /// Requests a picture to be timed when the thread is idle; other requests come first. Ends in trialReady().
  /// A second request replaces the first.
  int requestTrial(const VolumePtr& volume, const Scene& scene, QSize pixels, PictureLevel level);
  void dropTrial();
  /// Requests a picture to be saved, independent of the screen. Such pictures are drawn in order, after those
  /// on screen. Each ends in pictureReady() with the returned number.
  int requestPicture(const VolumePtr& volume, const Scene& scene, const RenderOptions& options);
  /// Cancels all pictures to be saved.
  void cancelPictures();
  /// Returns the finished share of the picture to be saved, 0 to 1.
  double pictureDone() const;
  /// Requests thumbnails of these scenes, with lowest priority. Returns the number of the batch. Each ends in
  /// thumbnailReady(), or in nothing if it fails. A second batch replaces the first.
  int requestThumbnails(const VolumePtr& volume, std::vector<Scene> scenes, QSize pixels);

 Q_SIGNALS:
  void screenPictureReady(const volumen::ScreenPicture& picture);
  void answered(volumen::ViewId view, int number, volumen::Answer answer);
  /// A sentence; not sent for cancelled work.
  void failed(volumen::ViewId view, const QString& sentence);
  void trialReady(const volumen::Trial& trial);
  /// If `drawn` is null, `failure` says why.
  void pictureReady(int number, const std::shared_ptr<volumen::Drawn>& drawn, const QString& failure);
  void thumbnailReady(int batch, int n, const QImage& image);

 private:
  using Clock = std::chrono::steady_clock;
  // A request whose picture at rest is not drawn yet.
  struct Pending {
    ScreenRequest request;
    Work next = Work::draft;
    double finerFactor = 1;   // of the finer draft
    Clock::time_point since;  // WaitingView::waited counts from here
  };
  struct View {
    VolumePtr volume;  // null if hidden
    int shownAt = 0;   // number_ when that volume was shown; its requests have larger numbers
    PictureLevel level;
    std::optional<Pending> pending;
    CancelToken cancel;      // of its first drafts
    CancelToken restCancel;  // of work that is interrupted by drafts
    int awaited = 0;         // the open request; for the thread of this object
  };
  struct PictureRequest {
    int number;
    VolumePtr volume;
    Scene scene;
    RenderOptions options;
    CancelToken cancel;
  };
  struct TrialRequest {
    VolumePtr volume;
    ScreenRequest request;
  };
  struct Thumbnails {
    VolumePtr volume;
    std::vector<Scene> scenes;
    QSize pixels;
    std::size_t next = 0;
  };
  struct Answered {
    ViewId view;
    int number;
    Answer answer;
  };
  enum class Outcome { drawn, cancelled, failed };

  // On the thread of this object.
  void answer(ViewId view, int number, Answer answer);
  void tellAnswers();
  void deliver(const ScreenPicture& picture);
  void deliverFailure(ViewId view, int number, const QString& sentence, bool last);

  // On the render thread.
  void run();
  std::optional<Turn> waitForTurn(std::unique_lock<std::mutex>& lock);
  void dropUnused(std::unique_lock<std::mutex>& lock);
  Waiting waiting() const;
  void drawDraft(ViewId id, std::unique_lock<std::mutex>& lock);
  void drawFiner(ViewId id, std::unique_lock<std::mutex>& lock);
  void drawRest(ViewId id, std::unique_lock<std::mutex>& lock);
  void drawSaved(std::unique_lock<std::mutex>& lock);
  void drawTrial(std::unique_lock<std::mutex>& lock);
  void drawThumbnail(std::unique_lock<std::mutex>& lock);
  ViewDrawing& drawingOf(ViewId id, const VolumePtr& volume, int shownAt);
  Draw drawOf(const VolumePtr& volume);
  Outcome drawScreen(ViewId id, const ScreenRequest& request, Pass pass, bool atRest,
                     const CancelToken& cancel, const PlannedPass* ahead = nullptr);
  bool staysQuiet(ViewId id, int number, std::unique_lock<std::mutex>& lock);
  void follow(ViewId id, int number, Outcome outcome, std::optional<Work> next, double finerFactor = 1);
  void useCpu();

  const MakeDraw makeDraw_;
  const std::shared_ptr<SeriesPool> pool_;

  int number_ = 0;  // of the last request or show(); for the thread of this object, as is `answers_`
  std::deque<Answered> answers_;

  mutable std::mutex mutex_;  // guards from here ...
  std::condition_variable wake_;
  std::map<ViewId, View> views_;
  std::optional<ViewId> gestureView_;
  std::deque<PictureRequest> pictures_;
  int pictureNumber_ = 0;
  std::optional<TrialRequest> trial_;
  int trialNumber_ = 0;
  std::optional<Thumbnails> thumbnails_;
  int thumbnailBatch_ = 0;
  CancelToken trialCancel_;    // of trials and thumbnails
  CancelToken pictureCancel_;  // of the picture being drawn
  Resampler resampler_ = Resampler::cpu;
  bool errorWanted_ = false;
  bool closing_ = false;  // ... to here

  // Used on the render thread only.
  std::map<ViewId, ViewDrawing> drawings_;
  Clock::time_point quietAt_;  // when the pause after the last draft is long enough

  std::thread thread_;
};

}  // namespace volumen
