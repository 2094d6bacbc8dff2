#include "ui/controller/snapshot.h"

#include "io/files/picture_file.h"

namespace volumen {

Snapshot::Snapshot(RenderController& controller, QObject* parent) : QObject(parent), controller_(controller) {
  pool_.setMaxThreadCount(1);
  connect(&controller_, &RenderController::pictureReady, this,
          [this](const std::shared_ptr<Drawn>& drawn, const QString& failure) {
            if (drawn)
              write(drawn);
            else
              Q_EMIT failed(failure);
          });
}

Snapshot::~Snapshot() { pool_.waitForDone(); }

void Snapshot::save(const Scene& scene, const RenderOptions& options, const QString& path) {
  path_ = path;
  Q_EMIT begun();
  controller_.requestPicture(scene, options);
}

void Snapshot::write(const std::shared_ptr<Drawn>& drawn) {
  const auto text =
      pictureText(drawn->plan, {estimateOf(drawn->error), measured_ ? measured_(drawn->plan) : std::nullopt});
  pool_.start([this, drawn, text, path = path_] {
    const Status status = writePng(drawn->picture, path.toStdString(), text);
    const QString sentence = status ? QString() : QString::fromStdString(status.message());
    QMetaObject::invokeMethod(
        this,
        [this, path, sentence] {
          if (sentence.isEmpty())
            Q_EMIT saved(path);
          else
            Q_EMIT failed(sentence);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
