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

/// How a request for the screen ended.
enum class Answer {
  drawn,      ///< its picture at rest is on screen
  replaced,   ///< another was made for the view
  cancelled,  ///< the view is hidden or shows another volume, there are no pixels, or the service closes
  failed      ///< failed() has told why
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

/// Draws the 3D pictures of all views on one thread of its own, in the order of nextTurn(): of what a view
/// asks for only the latest, first as a draft of fewer pixels within the frame time, then at the level of
/// pictures at rest once nothing new was asked for a moment, in which that picture is planned. Where that one
/// is expected to take long, a first picture by plain steps comes before it. Views of one volume share what
/// was computed of it. Asking never waits. All functions are for the thread of this object; signals come from
/// its event loop, only the last answers from the destructor.
class DrawService : public QObject {
  Q_OBJECT
 public:
  /// `pool`: where it finds and keeps what is computed of volumes.
  explicit DrawService(MakeDraw makeDraw, std::shared_ptr<SeriesPool> pool = std::make_shared<SeriesPool>(),
                       QObject* parent = nullptr);
  /// Gives up what is being drawn and waits for the thread, which checks its token between rows. What has no
  /// answer yet is answered: cancelled.
  ~DrawService() override;

  /// What a view shows from now on; null: it is hidden, and nothing is drawn of it. No picture of the volume
  /// before is told any more.
  void show(ViewId view, VolumePtr volume);
  /// Asks for a picture of so many device pixels; a scene without a camera is fitted to the picture. Returns
  /// the number, larger than all before, by which it is answered exactly once.
  int request(ViewId view, const Scene& scene, QSize pixels);
  /// The view of the last gesture, which goes first.
  void setGestureView(ViewId view);
  /// What resamples the full pictures asked for from now on (drafts are the CPU's). Where OpenGL fails,
  /// failed() says why and the CPU does it.
  void setResampler(Resampler resampler);
  /// Whether pictures asked for from now on estimate the error of each pixel, where they can.
  void setErrorWanted(bool wanted);
  /// The level of the full pictures asked for from now on.
  void setLevel(ViewId view, PictureLevel level);
  PictureLevel level(ViewId view) const;
  /// Asks for a picture to be drawn and timed, as soon as there is nothing else to do; what comes meanwhile
  /// is drawn first. Ends in trialReady(). A second takes the place of the first.
  int requestTrial(const VolumePtr& volume, const Scene& scene, QSize pixels, PictureLevel level);
  void dropTrial();
  /// Asks for a picture of a volume to be saved, whatever is on screen by then; they are drawn in order, when
  /// the screen has its pictures. Each ends in pictureReady() with the number returned.
  int requestPicture(const VolumePtr& volume, const Scene& scene, const RenderOptions& options);
  /// Gives up all of them.
  void cancelPictures();
  /// How much of the picture to be saved is drawn, 0 to 1.
  double pictureDone() const;
  /// Asks for small pictures of these scenes, whole, after everything else; returns the number of the batch.
  /// Each ends in thumbnailReady() or, where it cannot be drawn, in nothing. A second takes the place of the
  /// first.
  int requestThumbnails(const VolumePtr& volume, std::vector<Scene> scenes, QSize pixels);

 Q_SIGNALS:
  void screenPictureReady(const volumen::ScreenPicture& picture);
  void answered(volumen::ViewId view, int number, volumen::Answer answer);
  /// A sentence; not for what was cancelled.
  void failed(volumen::ViewId view, const QString& sentence);
  void trialReady(const volumen::Trial& trial);
  /// `drawn` null: `failure` says why.
  void pictureReady(int number, const std::shared_ptr<volumen::Drawn>& drawn, const QString& failure);
  void thumbnailReady(int batch, int n, const QImage& image);

 private:
  using Clock = std::chrono::steady_clock;
  // A request whose picture at rest is not drawn yet.
  struct Pending {
    ScreenRequest request;
    Work next = Work::draft;
    double firstFactor = 1;   // of the first picture
    Clock::time_point since;  // WaitingView::waited
  };
  struct View {
    VolumePtr volume;  // null: hidden
    int shownAt = 0;   // number_ when that volume was shown: its requests have larger ones
    PictureLevel level;
    std::optional<Pending> pending;
    CancelToken cancel;      // of its first drafts
    CancelToken restCancel;  // of what gives way to drafts
    int awaited = 0;         // the request without an answer; for the thread of this object
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
  void drawFirst(ViewId id, std::unique_lock<std::mutex>& lock);
  void drawRest(ViewId id, std::unique_lock<std::mutex>& lock);
  void drawSaved(std::unique_lock<std::mutex>& lock);
  void drawTrial(std::unique_lock<std::mutex>& lock);
  void drawThumbnail(std::unique_lock<std::mutex>& lock);
  ViewDrawing& drawingOf(ViewId id, const VolumePtr& volume, int shownAt);
  Draw drawOf(const VolumePtr& volume);
  Outcome drawScreen(ViewId id, const ScreenRequest& request, Pass pass, bool atRest,
                     const CancelToken& cancel, const PlannedPass* ahead = nullptr);
  bool staysQuiet(ViewId id, int number, std::unique_lock<std::mutex>& lock);
  void follow(ViewId id, int number, Outcome outcome, std::optional<Work> next, double firstFactor = 1);
  void useCpu();

  const MakeDraw makeDraw_;
  const std::shared_ptr<SeriesPool> pool_;

  int number_ = 0;  // of the last request, or the last showing; for the thread of this object, as these
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
  CancelToken trialCancel_;    // of thumbnails, too
  CancelToken pictureCancel_;  // of the picture being drawn
  Resampler resampler_ = Resampler::cpu;
  bool errorWanted_ = false;
  bool closing_ = false;  // ... to here

  // Of the render thread alone.
  std::map<ViewId, ViewDrawing> drawings_;
  Clock::time_point quietAt_;  // when nothing new was asked for long enough since the last draft

  std::thread thread_;
};

}  // namespace volumen
