#include "ui/controller/preset_thumbnails.h"

namespace volumen {

PresetThumbnails::PresetThumbnails(DrawService& drawService, MakeScene makeScene, QObject* parent)
    : QObject(parent), drawService_(drawService), makeScene_(std::move(makeScene)) {
  pool_.setMaxThreadCount(1);
  pool_.setThreadPriority(QThread::LowPriority);
  connect(&drawService_, &DrawService::thumbnailReady, this, [this](int batch, int n, const QImage& image) {
    if (batch == batch_) Q_EMIT ready(names_[std::size_t(n)], image);
  });
}

PresetThumbnails::~PresetThumbnails() {
  stop();
  pool_.waitForDone();
}

void PresetThumbnails::stop() {
  cancel_.cancel();
  cancel_ = CancelToken();
  batch_ = 0;
  drawService_.requestThumbnails(nullptr, {}, {});
}

void PresetThumbnails::start(VolumePtr volume, const std::vector<std::string>& presets, int edge) {
  stop();
  pool_.start([this, volume = std::move(volume), presets, edge, cancel = cancel_] {
    auto made = std::make_shared<Made>();
    for (const std::string& preset : presets) {
      if (cancel.cancelled()) return;
      Result<Scene> scene = makeScene_(preset, *volume);
      if (!scene) continue;
      made->names.push_back(QString::fromStdString(preset));
      made->scenes.push_back(std::move(*scene));
    }
    QMetaObject::invokeMethod(
        this,
        [this, volume, made, edge, cancel] {
          if (cancel.cancelled()) return;
          names_ = std::move(made->names);
          batch_ = drawService_.requestThumbnails(volume, std::move(made->scenes), {edge, edge});
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
