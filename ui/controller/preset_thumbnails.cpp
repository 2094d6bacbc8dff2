#include "ui/controller/preset_thumbnails.h"

namespace volumen {

PresetThumbnails::PresetThumbnails(DrawService& drawService, MakeScene makeScene, QObject* parent)
    : QObject(parent), drawService_(drawService), makeScene_(std::move(makeScene)) {
  connect(&drawService_, &DrawService::thumbnailReady, this, [this](int batch, int n, const QImage& image) {
    if (batch == batch_) Q_EMIT ready(names_[std::size_t(n)], image);
  });
}

PresetThumbnails::~PresetThumbnails() { stop(); }

void PresetThumbnails::stop() {
  lane_.giveUpAll();
  batch_ = 0;
  drawService_.requestThumbnails(nullptr, {}, {});
}

void PresetThumbnails::start(VolumePtr volume, const std::vector<std::string>& presets, int edge) {
  stop();
  lane_.run(
      {},
      [makeScene = makeScene_, volume, presets](const Job& job) {
        Made made;
        for (const std::string& preset : presets) {
          if (job.cancelled()) break;
          Result<Scene> scene = makeScene(preset, *volume);
          if (!scene) continue;
          made.names.push_back(QString::fromStdString(preset));
          made.scenes.push_back(std::move(*scene));
        }
        return made;
      },
      [this, volume, edge](Made made) {
        names_ = std::move(made.names);
        batch_ = drawService_.requestThumbnails(volume, std::move(made.scenes), {edge, edge});
      });
}

}  // namespace volumen
