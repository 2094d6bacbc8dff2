#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include "ui/controller/masker.h"
#include "ui/main_window.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/camera_panel.h"
#include "ui/panels/clip_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/segment_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/documents_window.h"
#include "ui/widgets/fold_title.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"

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

}  // namespace

void MainWindow::makeDocks() {
  studies_ = new StudiesPanel(open_);
  auto* camera = new CameraPanel(session_, [this] { return view()->camera(); });
  connect(camera, &CameraPanel::viewRequested, this, [this](const QString& name) { view()->showView(name); });
  connect(camera, &CameraPanel::resetRequested, this, [this] { view()->resetView(); });
  const auto add = [this](const char* name, const QString& title, QWidget* panel) {
    bench_->addDock(QLatin1String(name), title, panel);
  };
  bench_->addDock(QStringLiteral("studies"), tr("Studies"), studies_, Qt::LeftDockWidgetArea);
  add("transfer", tr("Opacity and colour"), new TransferPanel(session_));
  add("lights", tr("Lights"),
      Workbench::scrolling(stacked(new LightsPanel(session_), new MaterialPanel(session_))));
  add("clip", tr("Clip"), Workbench::scrolling(new ClipPanel(session_)));
  add("camera", tr("Camera"), Workbench::scrolling(camera));
}

void MainWindow::makeActions() {
  const std::vector<Workbench::ActionEntry> table{
      {"openFolder",
       tr("Open folder..."),
       {QKeySequence::Open},
       "open",
       false,
       [this](bool) { askForFolder(); }},
      {"openFile", tr("Open file..."), {tr("Ctrl+Shift+O")}, "", false, [this](bool) { askForFile(); }},
      {"openSample",
       tr("Sample study"),
       {},
       "sample",
       false,
       [this](bool) { open({QStringLiteral("phantom:ct-head")}); }},
      {"quit", tr("Quit"), {QKeySequence::Quit}, "", false, [this](bool) { close(); }},
      {"maximise", tr("Maximise view"), {tr("F10")}, "", true, [this](bool on) { setMaximised(on); }},
      {"leaveMaximised",
       tr("Leave maximised view"),
       {tr("Esc")},
       "",
       false,
       [this](bool) { bench_->action("maximise")->setChecked(false); }},
      {"resetLayout", tr("Reset layout"), {}, "", false, [this](bool) { resetLayout(); }},
      {"fullScreen",
       tr("Full screen"),
       {tr("F11")},
       "",
       true,
       [this](bool on) {
         setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
       }},
      {"lightTheme",
       tr("Light theme"),
       {},
       "",
       true,
       [this](bool on) {
         session_.prefer([on](Preferences& p) { p.theme = on ? Theme::light : Theme::dark; });
       }},
      {"hideNames",
       tr("Hide names"),
       {},
       "",
       true,
       [this](bool on) { session_.prefer([on](Preferences& p) { p.hideNames = on; }); }},
      {"preferences", tr("Preferences..."), {tr("Ctrl+,")}, "", false, [this](bool) { showPreferences(); }},
  };
  for (const Workbench::ActionEntry& entry : table) bench_->addAction(entry);
  bench_->action("leaveMaximised")->setEnabled(false);
  for (auto [name, action, key] :
       {std::tuple("undo", session_.undoStack().createUndoAction(this, tr("Undo")), QKeySequence::Undo),
        std::tuple("redo", session_.undoStack().createRedoAction(this, tr("Redo")), QKeySequence::Redo)}) {
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(key);
    action->setProperty("iconName", QLatin1String(name));
    bench_->actions[action->objectName()] = action;
    // Its text, which else is its tool tip, names what was done to what.
    connect(action, &QAction::changed, action, [action = action] {
      if (action->toolTip() != toolTipOf(action->text())) action->setToolTip(toolTipOf(action->text()));
    });
  }
}

void MainWindow::askForFolder() {
  auto* dialog = new QFileDialog(this, tr("Open folder"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { open({path}); });
  dialog->open();
}

void MainWindow::askForFile() {
  auto* dialog = new QFileDialog(this, tr("Open file"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  connect(dialog, &QFileDialog::filesSelected, this, [this](const QStringList& paths) { open(paths); });
  dialog->open();
}

}  // namespace volumen
