#include "ui/exports/scene_pictures.h"

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>

#include "results/pictures/annotate.h"
#include "results/text/text.h"
#include "ui/controller/loader.h"
#include "ui/overlays/view_overlays.h"

namespace volumen {

namespace {

constexpr double leastPart = 0.02;  // no estimate is made below this share

QString leftText(double seconds) {
  if (seconds < 60) return tr("%1 s left").arg(std::ceil(seconds));
  return tr("%1 min left").arg(std::ceil(seconds / 60));
}

// Returns the overlays of a view that are chosen for a picture, and the warnings among them.
Overlays chosenOverlays(const Overlays& all, const Annotations& chosen,
                        const std::vector<Warning>& warnings) {
  Overlays o;
  if (chosen.warnings) o = warningOverlays(warnings);
  if (chosen.patient) o.topLeft = all.topLeft;
  if (chosen.scaleBar) o.mmPerPixel = all.mmPerPixel;
  if (!chosen.letters) return o;
  o.left = all.left;
  o.right = all.right;
  o.top = all.top;
  o.bottom = all.bottom;
  return o;
}

// Reads a time point, and cuts away what is not drawn.
Result<LoadedSeriesPtr> loadCut(const Series& step, const Mask& mask, bool withoutTable, const Job& job) {
  const auto read = loadForSlices(step, job);
  if (!read) return read;
  const auto left = std::make_shared<LoadedSeries>(**read);
  if (!mask.empty()) {
    const auto cut = masked(*left->volume, mask, job.cancel());
    if (!cut) return cut.error();
    left->volume = *cut;
  }
  if (!withoutTable) return LoadedSeriesPtr(left);
  if (const auto patient = masked(*left->volume, Mask{true, {}}, job.cancel())) left->volume = *patient;
  return LoadedSeriesPtr(left);
}

class ScenePictures : public QObject, public PictureMaker {
 public:
  ScenePictures(DrawService& drawService, const SnapshotRequest& request, const MeasuredErrorOf& measured)
      : drawService_(drawService), request_(request), measured_(measured), drawn_(request.seen.series) {
    connect(&drawService_, &DrawService::pictureReady, this,
            [this](int number, const std::shared_ptr<Drawn>& drawn, const QString& failure) {
              if (number != number_) return;
              drawn ? finish(drawn) : std::exchange(done_, {})(Error{failure.toStdString()});
            });
  }

  std::size_t count() const override {
    return isOfSteps() ? request_.steps.series.size() : std::size_t(request_.pictures);
  }
  void make(std::size_t n, JobLane& lane, const Done& done) override {
    if (n == 0) clock_.start();
    lane_ = &lane, done_ = done;
    if (!isOfSteps()) return draw(360.0 * double(n) / request_.pictures);
    number_ = 0;
    lane.run(
        {},
        [step = request_.steps.series[n], mask = request_.steps.mask,
         withoutTable = request_.steps.withoutTable](const Job& job) {
          return loadCut(*step, mask, withoutTable, job);
        },
        [this](const Result<LoadedSeriesPtr>& read) {
          if (!read) return std::exchange(done_, {})(read.error());
          drawn_ = *read;
          draw(0);
        });
  }
  void giveUp() override { drawService_.cancelPictures(); }
  void tellProgress(const Job& job, std::size_t made) const override {
    const bool isDrawing = done_ && number_ > 0;
    const double now = (double(made) + (isDrawing ? drawService_.pictureDone() : 0)) / double(count());
    part_ = std::clamp(now, part_, 1.0);
    QString text = tr("%1: %2 %").arg(job.name().text()).arg(std::floor(100 * part_));
    const double seconds = clock_.isValid() ? double(clock_.elapsed()) / 1000 : 0;
    if (part_ >= leastPart) text += tr(", %1").arg(leftText(seconds * (1 - part_) / part_));
    job.tell(text, part_);
  }
  QString cancelledText() const override { return tr("Cancelled."); }
  // The render thread draws one picture after another, and a turntable chooses its names after the one
  // before.
  bool isOneAtATime() const override { return true; }

 private:
  bool isOfSteps() const { return !request_.steps.series.empty(); }

  void draw(double degrees) {
    Scene scene = request_.seen.scene;
    if (request_.background) scene.background = *request_.background;
    scene.camera = turned(*scene.camera, degrees);
    RenderOptions options;
    options.size = {request_.size.width(), request_.size.height()};
    options.quality = request_.quality;
    number_ = drawService_.requestPicture(drawn_->volume, scene, options);
  }

  void finish(const std::shared_ptr<Drawn>& drawn) {
    const SnapshotSeen& seen = request_.seen;
    MadePicture made;
    // What was measured is the error of the volume on screen.
    const auto measured = isOfSteps() ? std::nullopt : measured_(drawn->plan);
    made.text = pictureText(drawn->plan, {estimateOf(drawn->plan, drawn->error), measured});
    std::vector<Warning> warnings = drawn_->warnings;
    warnings.insert(warnings.end(), drawn->warnings.begin(), drawn->warnings.end());
    for (const PictureText& more :
         {textOfSegments(seen.segments, drawn->plan.segments), warningText(warnings)})
      made.text.insert(made.text.end(), more.begin(), more.end());
    const HidingNames hiding(seen.namesHidden);
    made.overlays = chosenOverlays(viewOverlays(*drawn_, *drawn->plan.scene.camera, drawn->picture.size),
                                   request_.shown, warnings);
    lane_->run(
        {},
        [drawn, picture = made](const Job&) {
          MadePicture whole = picture;
          whole.image = imageForFile(drawn->picture);
          if (!whole.overlays.empty()) annotate(whole.image, whole.overlays);
          return Result<MadePicture>(std::move(whole));
        },
        [this](const Result<MadePicture>& finished) { std::exchange(done_, {})(finished); });
  }

  DrawService& drawService_;
  const SnapshotRequest request_;
  const MeasuredErrorOf measured_;
  LoadedSeriesPtr drawn_;  // the series seen, or the time point that was read last
  JobLane* lane_ = nullptr;
  Done done_;       // set while a picture is being made
  int number_ = 0;  // of the requested picture
  QElapsedTimer clock_;
  mutable double part_ = 0;  // reported last
};

}  // namespace

PictureMakerPtr scenePictures(DrawService& drawService, const SnapshotRequest& request,
                              const MeasuredErrorOf& measured) {
  return std::make_shared<ScenePictures>(drawService, request, measured);
}

}  // namespace volumen
