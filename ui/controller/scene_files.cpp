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

SceneFiles::SceneFiles(Jobs& jobs, QObject* parent) : QObject(parent), open_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

SceneFiles::~SceneFiles() { save_.wait(); }

void SceneFiles::open(const QString& path) {
  open_.run(
      tr("Reading the scene"), [path](const Job&) { return sceneFromFile(path.toStdString()); },
      [this](const Result<Scene>& scene) {
        if (scene)
          Q_EMIT opened(*scene);
        else
          Q_EMIT failed(QString::fromStdString(scene.message()));
      });
}

void SceneFiles::save(const QString& path, const Scene& scene) {
  save_.run(
      tr("Saving the scene"), [path, scene](const Job&) { return writeScene(path.toStdString(), scene); },
      [this, path](const Status& status) {
        if (status)
          Q_EMIT saved(path);
        else
          Q_EMIT failed(QString::fromStdString(status.message()));
      });
}

}  // namespace volumen
