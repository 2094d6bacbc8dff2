#pragma once

#include "ui/document/job_lane.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The scene of a scene file, or of a picture of ours (PNG or JPEG). The Error names the file.
Result<Scene> sceneFromFile(const std::string& path);

/// Reads and writes scenes; each a job.
class SceneFiles : public QObject {
  Q_OBJECT
 public:
  explicit SceneFiles(Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~SceneFiles() override;

  void open(const QString& path);
  void save(const QString& path, const Scene& scene);

 Q_SIGNALS:
  void opened(const volumen::Scene& scene);
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  JobLane open_, save_;
};

}  // namespace volumen
