#include "ui/controller/scene_files.h"

#include "io/files/output_file.h"
#include "io/files/scene_file.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

Status writeScene(const std::string& path, const Scene& scene) {
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = file->write(sceneToJson(scene)); !s) return s;
  return file->commit();
}

}  // namespace

Result<Scene> sceneFromFile(const std::string& path) {
  const auto text = sceneText(path);
  if (!text) return text.error();
  auto scene = sceneFromJson(*text);
  if (!scene) return Error{path + ": " + scene.message()};
  return scene;
}

SceneFiles::SceneFiles(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }

SceneFiles::~SceneFiles() { pool_.waitForDone(); }

void SceneFiles::open(const QString& path) {
  pool_.start([this, path] {
    const Result<Scene> scene = sceneFromFile(path.toStdString());
    QMetaObject::invokeMethod(
        this,
        [this, scene] {
          if (scene)
            Q_EMIT opened(*scene);
          else
            Q_EMIT failed(QString::fromStdString(scene.message()));
        },
        Qt::QueuedConnection);
  });
}

void SceneFiles::save(const QString& path, const Scene& scene) {
  pool_.start([this, path, scene] {
    const Status status = writeScene(path.toStdString(), scene);
    QMetaObject::invokeMethod(
        this,
        [this, path, status] {
          if (status)
            Q_EMIT saved(path);
          else
            Q_EMIT failed(QString::fromStdString(status.message()));
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
