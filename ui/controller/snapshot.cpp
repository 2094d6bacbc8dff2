#include "ui/controller/snapshot.h"

#include <QClipboard>
#include <QFileInfo>
#include <QGuiApplication>
#include <algorithm>
#include <cmath>

#include "io/files/picture_file.h"
#include "ui/overlays/annotate.h"
#include "ui/overlays/view_overlays.h"
#include "ui/workspace/text.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

constexpr int tellEveryMs = 200;
constexpr double leastPart = 0.02;  // no estimate is made below this share

QString leftText(double seconds) {
  if (seconds < 60) return Snapshot::tr("%1 s left").arg(std::ceil(seconds));
  return Snapshot::tr("%1 min left").arg(std::ceil(seconds / 60));
}

Scene sceneOf(const SnapshotRequest& request, int picture) {
  Scene shown = request.seen.scene;
  if (request.background) shown.background = *request.background;
  shown.camera = turned(*shown.camera, 360.0 * picture / request.pictures);
  return shown;
}

// Returns a path for a turntable that overwrites no file: "CT Head (2).png".
QString freePath(const QString& path, int pictures) {
  const qsizetype dot = path.lastIndexOf(QLatin1Char('.'));
  const auto pathOf = [&](const std::string& name) { return QString::fromStdString(name) + path.mid(dot); };
  const auto isTaken = [&](const std::string& name) {
    for (int n = 0; n < pictures; ++n)
      if (QFileInfo::exists(numberedPath(pathOf(name), n))) return true;
    return false;
  };
  return pathOf(freeName(path.left(dot).toStdString(), isTaken));
}

}  // namespace

QString numberedPath(const QString& path, int number) {
  const qsizetype dot = path.lastIndexOf(QLatin1Char('.'));
  return path.left(dot) + QStringLiteral("-%1").arg(number, 3, 10, QLatin1Char('0')) + path.mid(dot);
}

Snapshot::Snapshot(DrawService& drawService, Jobs& jobs, QObject* parent)
    : QObject(parent), drawService_(drawService), jobs_(jobs) {
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

Snapshot::~Snapshot() { writing_.wait(); }

void Snapshot::take(const SnapshotRequest& request) {
  const Job job(tr("Rendering snapshot"));
  shots_.push_back({request, job, 0, 0, {}});
  jobs_.add(job, [this, id = job.id()] { cancel(id); });
  if (shots_.size() == 1) begin();
}

// Removes a waiting snapshot at once. The one in progress ends when the render thread cancels it.
void Snapshot::cancel(int job) {
  if (shots_.front().job.id() == job) return drawService_.cancelPictures();
  std::erase_if(shots_, [&](const Shot& shot) { return shot.job.id() == job; });
  Q_EMIT failed(tr("Cancelled."));
}

// Chooses the file names of a turntable after the snapshots before it are written.
void Snapshot::begin() {
  SnapshotRequest& request = shots_.front().request;
  if (request.pictures > 1) request.path = freePath(request.path, request.pictures);
  shots_.front().clock.start();
  tick_.start();
  draw();
}

void Snapshot::draw() {
  const Shot& shot = shots_.front();
  if (shot.job.cancelled()) return end(tr("Cancelled."));
  RenderOptions options;
  options.size = {shot.request.size.width(), shot.request.size.height()};
  options.quality = shot.request.quality;
  number_ = drawService_.requestPicture(shot.request.seen.series->volume, sceneOf(shot.request, shot.drawn),
                                        options);
}

void Snapshot::tellProgress() {
  Shot& shot = shots_.front();
  shot.part = std::max(shot.part, (shot.drawn + drawService_.pictureDone()) / shot.request.pictures);
  const double seconds = double(shot.clock.elapsed()) / 1000;
  QString text = tr("%1: %2 %").arg(shot.job.name().text()).arg(std::floor(100 * shot.part));
  if (shot.part >= leastPart) text += tr(", %1").arg(leftText(seconds * (1 - shot.part) / shot.part));
  shot.job.tell(text, shot.part);
}

void Snapshot::write(const std::shared_ptr<Drawn>& drawn) {
  const Shot& shot = shots_.front();
  const SnapshotSeen& seen = shot.request.seen;
  PictureText text = pictureText(drawn->plan, {estimateOf(drawn->plan, drawn->error),
                                               measured_ ? measured_(drawn->plan) : std::nullopt});
  std::vector<Warning> warnings = seen.series->warnings;
  warnings.insert(warnings.end(), drawn->warnings.begin(), drawn->warnings.end());
  for (const PictureText& more : {textOfSegments(seen.segments, drawn->plan.segments), warningText(warnings)})
    text.insert(text.end(), more.begin(), more.end());
  const glm::ivec2 size = drawn->picture.size;
  const HidingNames hiding(seen.namesHidden);
  const Overlays over = chosenOverlays(viewOverlays(*seen.series, *drawn->plan.scene.camera, size),
                                       shot.request.shown, warnings);
  const QString path =
      shot.request.pictures > 1 ? numberedPath(shot.request.path, shot.drawn) : shot.request.path;
  auto image = std::make_shared<QImage>();
  writing_.run(
      {},
      [drawn, text, over, path, image](const Job&) {
        *image = imageForFile(drawn->picture);
        if (!over.empty()) annotate(*image, over);
        return path.isEmpty() ? Status() : writeImage(*image, path.toStdString(), text);
      },
      [this, path, image](const Status& status) {
        written(path.isEmpty() ? *image : QImage(), path,
                status ? QString() : QString::fromStdString(status.message()));
      });
}

void Snapshot::written(const QImage& forClipboard, const QString& path, const QString& failure) {
  Shot& shot = shots_.front();
  if (!failure.isEmpty()) return end(failure);
  if (++shot.drawn < shot.request.pictures) return draw();
  if (path.isEmpty()) {
    QGuiApplication::clipboard()->setImage(forClipboard);
    Q_EMIT copied();
  } else {
    Q_EMIT saved(path, shot.request.pictures);
  }
  end({});
}

void Snapshot::end(const QString& failure) {
  tick_.stop();
  jobs_.remove(shots_.front().job);
  shots_.pop_front();
  if (!failure.isEmpty()) Q_EMIT failed(failure);
  if (!shots_.empty()) begin();
}

}  // namespace volumen
