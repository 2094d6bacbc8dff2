#pragma once

#include <QImage>

#include "ui/controller/draw_service.h"
#include "ui/controller/loader.h"

namespace volumen {

/// Makes a thumbnail of the open volume for each preset. Scenes are made on its own thread and drawn in idle
/// time of the render thread.
class PresetThumbnails : public QObject {
  Q_OBJECT
 public:
  PresetThumbnails(DrawService& drawService, MakeScene makeScene, QObject* parent = nullptr);
  ~PresetThumbnails() override;

  /// Makes the thumbnails of a volume in the order of `presets`, `edge` device pixels wide and high. Cancels
  /// those before.
  void start(VolumePtr volume, const std::vector<std::string>& presets, int edge);
  void stop();

 Q_SIGNALS:
  void ready(const QString& preset, const QImage& image);

 private:
  struct Made {
    std::vector<QString> names;
    std::vector<Scene> scenes;
  };

  DrawService& drawService_;
  const MakeScene makeScene_;
  std::vector<QString> names_;  // of the current batch
  int batch_ = 0;
  JobLane lane_{nullptr, QThread::LowPriority};
};

}  // namespace volumen
