#pragma once

#include <QThreadPool>

#include "ui/controller/render_controller.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// Saves pictures: drawn by the render thread, written by another.
class Snapshot : public QObject {
  Q_OBJECT
 public:
  explicit Snapshot(RenderController& controller, QObject* parent = nullptr);
  ~Snapshot() override;

  /// Where to ask what was measured of exactly the picture that a plan draws: written with it.
  void setMeasured(std::function<std::optional<MeasuredError>(const Plan&)> measured) {
    measured_ = std::move(measured);
  }
  /// One at a time: a second gives up the first.
  void save(const Scene& scene, const RenderOptions& options, const QString& path);
  void cancel() { controller_.cancelPicture(); }

 Q_SIGNALS:
  void begun();
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void write(const std::shared_ptr<Drawn>& drawn);

  RenderController& controller_;
  QThreadPool pool_;
  QString path_;
  std::function<std::optional<MeasuredError>(const Plan&)> measured_;
};

}  // namespace volumen
