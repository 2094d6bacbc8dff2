#include <QDockWidget>
#include <QVBoxLayout>

#include "ui/features/feature.h"
#include "ui/panels/camera_panel.h"
#include "ui/panels/clip_panel.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

QWidget* stacked(QWidget* above, QWidget* below) {
  auto* both = new QWidget;
  auto* column = new QVBoxLayout(both);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(above);
  column->addWidget(below);
  column->addStretch();
  return both;
}

// The panels of the scene: each reads the session and writes edits.
class Panels : public Feature {
 public:
  explicit Panels(Workbench& bench);

 private:
  QWidget* cameraPanel();
};

Panels::Panels(Workbench& bench) : Feature(bench) {
  const auto scrolling = Workbench::scrolling;
  const auto lights = [this] { return stacked(new LightsPanel(session_), new MaterialPanel(session_)); };
  const Qt::DockWidgetArea right = Qt::RightDockWidgetArea;
  const Workbench::DockEntry table[] = {
      {"transfer", tr("Opacity and colour"), new TransferPanel(session_), {right, 0}},
      {"lights", tr("Lights"), scrolling(lights()), {right, 10}},
      {"clip", tr("Clip"), scrolling(new ClipPanel(session_)), {right, 20}},
      {"camera", tr("Camera"), scrolling(cameraPanel()), {right, 80, false}},
  };
  for (const Workbench::DockEntry& entry : table) bench_.addDock(entry);
  connect(bench_.dock("clip"), &QDockWidget::visibilityChanged, &grid_, &ViewGrid::setClipShown);
}

QWidget* Panels::cameraPanel() {
  auto* panel = new CameraPanel(session_, [this] { return bench_.view()->camera(); });
  connect(panel, &CameraPanel::viewRequested, this,
          [this](const QString& name) { bench_.view()->showView(name); });
  connect(panel, &CameraPanel::resetRequested, this, [this] { bench_.view()->resetView(); });
  return panel;
}

}  // namespace

std::unique_ptr<Feature> makePanels(Workbench& bench) { return std::make_unique<Panels>(bench); }

}  // namespace volumen
