#include <QMenu>

#include "results/pictures/own_presets.h"
#include "results/text/text.h"
#include "ui/controller/preset_thumbnails.h"
#include "ui/features/feature.h"
#include "ui/panels/preset_bar.h"

namespace volumen {

namespace {

// Bar of presets, each with a thumbnail of the volume in focus.
class Presets : public Feature {
 public:
  explicit Presets(Workbench& bench);

 private:
  void choose(const QString& name);
  void addCommands(QMenu* more);
  void connectThumbnails();
  void drawThumbnails();
  void forgetThumbnails();
  void tellProblems();

  PresetThumbnails thumbnails_;
  PresetBar* bar_;
  VolumePtr thumbnailsOf_;  // the volume whose presets have thumbnails
};

Presets::Presets(Workbench& bench)
    : Feature(bench),
      thumbnails_(bench.document.drawService, bench.services.makeScene),
      bar_(new PresetBar(session_, bench.services.presets)) {
  bench_.menus.addWidget(bar_, {"toolBar", 30});
  Loader& loader = bench_.document.loader;
  connect(bar_, &PresetBar::presetChosen, this, &Presets::choose);
  connect(&bench_, &Workbench::commandsOpen, this, &Presets::addCommands);
  connect(&loader, &Loader::presetReady, this,
          [this](const QString& name, const Scene& scene, const VolumePtr& volume) {
            if (session_.series() && session_.series()->volume == volume)
              session_.choosePreset(tr("Preset %1").arg(name), name.toStdString(), scene);
          });
  connect(bar_, &PresetBar::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connectThumbnails();
  tellProblems();
}

void Presets::choose(const QString& name) {
  if (session_.series()) bench_.document.loader.makePreset(name, session_.series());
}

void Presets::addCommands(QMenu* more) {
  if (!session_.series()) return;
  QMenu* menu = more->addMenu(tr("3D presets"));
  for (const std::string& preset : bar_->names()) {
    QString text = shownText(preset);
    menu->addAction(text.replace(QLatin1Char('&'), QStringLiteral("&&")), this,
                    [this, name = QString::fromStdString(preset)] { choose(name); });
  }
}

void Presets::connectThumbnails() {
  connect(&thumbnails_, &PresetThumbnails::ready, bar_, &PresetBar::showThumbnail);
  connect(bar_, &PresetBar::listChanged, this, [this] {
    thumbnailsOf_.reset();
    drawThumbnails();
  });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) forgetThumbnails();
  });
  // Starts once the first picture of a series is drawn.
  connect(&bench_, &Workbench::drawnAtRest, bar_, [this] { drawThumbnails(); });
}

void Presets::drawThumbnails() {
  const VolumePtr volume = session_.series() ? session_.series()->volume : nullptr;
  if (!volume || std::exchange(thumbnailsOf_, volume) == volume) return;
  thumbnails_.start(volume, bar_->names(), int(PresetBar::thumbnailEdge * bar_->devicePixelRatioF()));
}

void Presets::forgetThumbnails() {
  thumbnails_.stop();
  thumbnailsOf_.reset();
}

void Presets::tellProblems() {
  QStringList problems;
  for (const std::string& problem : ownPresets().problems) problems << shownText(problem);
  if (!problems.isEmpty()) warnUntilDone(tr("A preset of yours cannot be read."), problems);
}

}  // namespace

std::unique_ptr<Feature> makePresets(Workbench& bench) { return std::make_unique<Presets>(bench); }

}  // namespace volumen
