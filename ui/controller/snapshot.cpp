#include "ui/controller/snapshot.h"

#include <QClipboard>
#include <QGuiApplication>

#include "io/files/picture_file.h"
#include "ui/views/annotate.h"
#include "ui/views/view_overlays.h"

namespace volumen {

namespace {

constexpr int tellEveryMs = 200;
constexpr double leastPart = 0.02;  // below, no estimate is made

Scene sceneOf(const Scene& scene, const SnapshotRequest& request, int picture) {
  Scene shown = scene;
  if (request.background) shown.background = *request.background;
  shown.camera = turned(*scene.camera, 360.0 * picture / request.pictures);
  return shown;
}

}  // namespace

QString numberedPath(const QString& path, int number) {
  const qsizetype dot = path.lastIndexOf(QLatin1Char('.'));
  return path.left(dot) + QStringLiteral("-%1").arg(number, 3, 10, QLatin1Char('0')) + path.mid(dot);
}

Snapshot::Snapshot(DrawService& drawService, QObject* parent) : QObject(parent), drawService_(drawService) {
  pool_.setMaxThreadCount(1);
  tick_.setInterval(tellEveryMs);
  connect(&tick_, &QTimer::timeout, this, &Snapshot::tellProgress);
  connect(&drawService_, &DrawService::pictureReady, this,
          [this](int number, const std::shared_ptr<Drawn>& drawn, const QString& failure) {
            if (number != number_) return;
            if (drawn)
              write(drawn);
            else
              end(failure);
          });
}

Snapshot::~Snapshot() { pool_.waitForDone(); }

void Snapshot::take(const ShownSeriesPtr& series, const Scene& scene, const SnapshotRequest& request) {
  Job job;
  job.series = series;
  job.scene = scene;
  job.request = request;
  jobs_.push_back(std::move(job));
  if (jobs_.size() == 1) begin();
}

void Snapshot::cancel() {
  if (jobs_.empty()) return;
  for (Job& job : jobs_) job.cancelled = true;
  drawService_.cancelPictures();
}

void Snapshot::begin() {
  jobs_.front().clock.start();
  tick_.start();
  Q_EMIT begun();
  draw();
}

void Snapshot::draw() {
  const Job& job = jobs_.front();
  if (job.cancelled) return end(tr("Cancelled."));
  RenderOptions options;
  options.size = {job.request.size.width(), job.request.size.height()};
  options.quality = job.request.quality;
  number_ =
      drawService_.requestPicture(job.series->volume, sceneOf(job.scene, job.request, job.drawn), options);
}

void Snapshot::tellProgress() {
  Job& job = jobs_.front();
  job.part = std::max(job.part, (job.drawn + drawService_.pictureDone()) / job.request.pictures);
  const double seconds = double(job.clock.elapsed()) / 1000;
  Q_EMIT progressed(job.part, job.part < leastPart ? -1 : seconds * (1 - job.part) / job.part);
}

void Snapshot::write(const std::shared_ptr<Drawn>& drawn) {
  const Job& job = jobs_.front();
  PictureText text =
      pictureText(drawn->plan, {estimateOf(drawn->error), measured_ ? measured_(drawn->plan) : std::nullopt});
  const PictureText warnings = warningText(job.series->warnings);
  text.insert(text.end(), warnings.begin(), warnings.end());
  const glm::ivec2 size = drawn->picture.size;
  const Overlays over = chosenOverlays(viewOverlays(*job.series, *drawn->plan.scene.camera, size),
                                       job.request.shown, job.series->warnings);
  const QString path =
      job.request.pictures > 1 ? numberedPath(job.request.path, job.drawn) : job.request.path;
  pool_.start([this, drawn, text, over, path] {
    QImage image = imageForFile(drawn->picture);
    if (!over.empty()) annotate(image, over);
    const Status status = path.isEmpty() ? Status() : writeImage(image, path.toStdString(), text);
    const QString failure = status ? QString() : QString::fromStdString(status.message());
    QMetaObject::invokeMethod(
        this,
        [this, path, failure, image = path.isEmpty() ? image : QImage()] { written(image, path, failure); },
        Qt::QueuedConnection);
  });
}

void Snapshot::written(const QImage& forClipboard, const QString& path, const QString& failure) {
  Job& job = jobs_.front();
  if (!failure.isEmpty()) return end(failure);
  if (++job.drawn < job.request.pictures) return draw();
  if (path.isEmpty()) {
    QGuiApplication::clipboard()->setImage(forClipboard);
    Q_EMIT copied();
  } else {
    Q_EMIT saved(path, job.request.pictures);
  }
  end({});
}

void Snapshot::end(const QString& failure) {
  tick_.stop();
  jobs_.pop_front();
  if (!failure.isEmpty()) Q_EMIT failed(failure);
  if (!jobs_.empty()) begin();
}

}  // namespace volumen
