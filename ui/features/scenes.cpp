
#include "results/pictures/scene_files.h"
#include "ui/controller/file_jobs.h"
#include "ui/features/feature.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/path_dialog.h"

namespace volumen {

namespace {

// Opens and saves scene files, for use with other series and on the command line.
class Scenes : public Feature {
 public:
  explicit Scenes(Workbench& bench);

 private:
  void askForScene();
  void openScene(const QString& path);
  void askForSceneFile();
  void saveScene(const Scene& scene, const QString& path);

  FileJobs files_;
};

Scenes::Scenes(Workbench& bench) : Feature(bench), files_(bench.document.jobs) {
  const std::vector<Place> places{{"fileMenu", 40, 10}};
  bench_.addAction(
      {"openScene", tr("Open scene..."), {}, "", false, [this](bool) { askForScene(); }, places});
  bench_.addAction(
      {"saveScene", tr("Save scene..."), {}, "", false, [this](bool) { askForSceneFile(); }, places});
  connect(&files_, &FileJobs::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
}

void Scenes::askForScene() {
  if (!session_.series()) return warn(tr("Open a series first."));
  const auto* dialog = openPathDialog(bench_.dialogParent(),
                                      {"openSceneDialog",
                                       tr("Open a scene"),
                                       tr("Scenes and snapshots (*.json *.png *.jpg *.jpeg);;All files (*)"),
                                       {},
                                       QFileDialog::ExistingFile});
  connect(dialog, &QFileDialog::fileSelected, this, &Scenes::openScene);
}

void Scenes::openScene(const QString& path) {
  files_.open(
      tr("Reading the scene"), [path] { return sceneFromFile(path.toStdString()); },
      [this](const Scene& scene) {
        bench_.banner.hide();
        session_.edit(tr("Open scene"), scene);
      });
}

void Scenes::askForSceneFile() {
  if (!session_.series()) return warn(tr("Open a series first."));
  const auto* dialog = openPathDialog(
      bench_.dialogParent(),
      {"saveSceneDialog", tr("Save the scene"), tr("Scenes (*.json)"), QStringLiteral("scene.json")});
  connect(dialog, &QFileDialog::fileSelected, this,
          [this, scene = bench_.sceneInView()](const QString& path) { saveScene(scene, path); });
}

void Scenes::saveScene(const Scene& scene, const QString& path) {
  files_.save(
      tr("Saving the scene"), [path, scene] { return writeScene(path.toStdString(), scene); },
      [this, path] { tell(tr("Saved %1").arg(path)); });
}

}  // namespace

std::unique_ptr<Feature> makeScenes(Workbench& bench) { return std::make_unique<Scenes>(bench); }

}  // namespace volumen
