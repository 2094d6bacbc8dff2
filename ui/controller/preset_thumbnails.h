#pragma once

#include <QImage>

#include "ui/controller/draw_service.h"
#include "ui/controller/loader.h"

namespace volumen {

/// A small picture of the open volume for each preset: their scenes are made on a thread of its own, drawn by
/// the render thread where that has nothing else to do.
class PresetThumbnails : public QObject {
  Q_OBJECT
 public:
  PresetThumbnails(DrawService& drawService, MakeScene makeScene, QObject* parent = nullptr);
  ~PresetThumbnails() override;

  /// Makes those of the volume, in this order, so many device pixels wide and high. Gives up the ones before.
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
  std::vector<QString> names_;  // of the batch being drawn
  int batch_ = 0;
  JobLane lane_{nullptr, QThread::LowPriority};
};

}  // namespace volumen
