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

// One line of the table of actions.
struct ActionEntry {
  const char* name;
  QString text;
  QList<QKeySequence> shortcuts;
  const char* icon;
  bool checkable;
  std::function<void(bool)> run;
};

// A panel that may be given less height than it has, so that the window fits a small screen; never less
// width.
class Scrolling : public QScrollArea {
 public:
  explicit Scrolling(QWidget* panel) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setWidget(panel);
  }

  QSize minimumSizeHint() const override {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), 60};
  }

 protected:
  // A scroll area tells nobody that what it holds has grown.
  bool eventFilter(QObject* object, QEvent* event) override {
    if (object == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(object, event);
  }
};

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

void MainWindow::addDock(const QString& name, const QString& title, QWidget* panel, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title);
  dock->setObjectName(name + QStringLiteral("Dock"));
  panel->setObjectName(name + QStringLiteral("Panel"));
  dock->setWidget(panel);
  addDockWidget(area, dock);
  new FoldTitle(dock);
  connect(dock->toggleViewAction(), &QAction::triggered, dock, &QWidget::raise);
  docks_[name] = dock;
}

void MainWindow::makeDocks() {
  studies_ = new StudiesPanel(open_);
  effects_ = new EffectsPanel;
  accuracy_ = new AccuracyPanel(session_);
  snapshotPanel_ = new SnapshotPanel;
  segment_ = new SegmentPanel(session_);
  auto* camera = new CameraPanel(session_, [this] { return view()->camera(); });
  connect(camera, &CameraPanel::viewRequested, this, [this](const QString& name) { view()->showView(name); });
  connect(camera, &CameraPanel::resetRequested, this, [this] { view()->resetView(); });
  const auto left = Qt::LeftDockWidgetArea, right = Qt::RightDockWidgetArea;
  addDock(QStringLiteral("studies"), tr("Studies"), studies_, left);
  addDock(QStringLiteral("transfer"), tr("Opacity and colour"), new TransferPanel(session_), right);
  addDock(QStringLiteral("lights"), tr("Lights"),
          new Scrolling(stacked(new LightsPanel(session_), new MaterialPanel(session_))), right);
  addDock(QStringLiteral("clip"), tr("Clip"), new Scrolling(new ClipPanel(session_)), right);
  addDock(QStringLiteral("camera"), tr("Camera"), new Scrolling(camera), right);
  addDock(QStringLiteral("effects"), tr("Effects"), effects_, right);
  addDock(QStringLiteral("accuracy"), tr("Quality and speed"), new Scrolling(accuracy_), right);
  addDock(QStringLiteral("segment"), tr("Segment"), new Scrolling(segment_), right);
  addDock(QStringLiteral("snapshot"), tr("Snapshot"), new Scrolling(snapshotPanel_), right);
  auto* measurements = new MeasurementsPanel(session_, measurer_);
  addDock(QStringLiteral("measurements"), tr("Measure"), measurements, right);
  connectMeasurements(measurements);
  makeReferenceDocks();
}

void MainWindow::makeActions() {
  const auto view = [this](const char* name) {
    return [this, name](bool) { this->view()->showView(QLatin1String(name)); };
  };
  const std::vector<ActionEntry> table{
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
      {"openSession", tr("Open session..."), {}, "", false, [this](bool) { askForSession(); }},
      {"saveSession", tr("Save session"), {QKeySequence::Save}, "", false, [this](bool) { saveSession(); }},
      {"saveSessionAs",
       tr("Save session as..."),
       {tr("Ctrl+Shift+S")},
       "",
       false,
       [this](bool) { askForSessionFile(); }},
      {"snapshot",
       tr("Save snapshot..."),
       {tr("Ctrl+E")},
       "snapshot",
       false,
       [this](bool) { snapshotPanel_->askWhere(); }},
      {"copySnapshot",
       tr("Copy snapshot"),
       {QKeySequence::Copy},
       "",
       false,
       [this](bool) { snapshotPanel_->copy(); }},
      {"openScene", tr("Open scene..."), {}, "", false, [this](bool) { askForScene(); }},
      {"saveScene", tr("Save scene..."), {}, "", false, [this](bool) { askForSceneFile(); }},
      {"quit", tr("Quit"), {QKeySequence::Quit}, "", false, [this](bool) { close(); }},
      {"resetView", tr("Reset view"), {tr("F")}, "reset", false, [this](bool) { resetViewInFocus(); }},
      {"viewAnterior", tr("Anterior view"), {tr("A")}, "view", false, view("anterior")},
      {"viewPosterior", tr("Posterior view"), {tr("P")}, "", false, view("posterior")},
      {"viewLeft", tr("Left view"), {tr("L")}, "", false, view("left")},
      {"viewRight", tr("Right view"), {tr("R")}, "", false, view("right")},
      {"viewSuperior", tr("Superior view"), {tr("S")}, "", false, view("superior")},
      {"viewInferior", tr("Inferior view"), {tr("I")}, "", false, view("inferior")},
      {"maximise", tr("Maximise view"), {tr("F10")}, "", true, [this](bool on) { setMaximised(on); }},
      {"leaveMaximised",
       tr("Leave maximised view"),
       {tr("Esc")},
       "",
       false,
       [this](bool) { actions_.at(QStringLiteral("maximise"))->setChecked(false); }},
      {"resetLayout", tr("Reset layout"), {}, "", false, [this](bool) { resetLayout(); }},
      {"fullScreen",
       tr("Full screen"),
       {tr("F11")},
       "",
       true,
       [this](bool on) {
         setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
       }},
      {"openGlResampler",
       tr("Use OpenGL (usually slower without a GPU)"),
       {},
       "",
       true,
       [this](bool on) { setResampler(on ? Resampler::gl : Resampler::cpu); }},
      {"showError", tr("Show error map"), {}, "", true, [](bool) {}},
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
      {"shortcuts", tr("Mouse and keys"), {tr("?")}, "help", false, [this](bool) { showShortcuts(); }},
      {"documentation",
       tr("Documentation"),
       {QKeySequence::HelpContents},
       "",
       false,
       [this](bool) { (new DocumentsWindow(this))->show(); }},
      {"about", tr("About volumen"), {}, "", false, [this](bool) { showAbout(); }},
  };
  for (const ActionEntry& entry : table) {
    auto* action = new QAction(entry.text, this);
    action->setObjectName(QLatin1String(entry.name));
    action->setShortcuts(entry.shortcuts);
    action->setCheckable(entry.checkable);
    action->setProperty("iconName", QLatin1String(entry.icon));
    connect(action, entry.checkable ? &QAction::toggled : &QAction::triggered, this, entry.run);
    addAction(action);
    actions_[action->objectName()] = action;
  }
  makeSceneToolActions();
  actions_[QStringLiteral("leaveMaximised")]->setEnabled(false);
  for (auto [name, action, key] :
       {std::tuple("undo", session_.undoStack().createUndoAction(this, tr("Undo")), QKeySequence::Undo),
        std::tuple("redo", session_.undoStack().createRedoAction(this, tr("Redo")), QKeySequence::Redo)}) {
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(key);
    action->setProperty("iconName", QLatin1String(name));
    actions_[action->objectName()] = action;
    // Its text, which else is its tool tip, names what was done to what.
    connect(action, &QAction::changed, action, [action = action] {
      if (action->toolTip() != toolTipOf(action->text())) action->setToolTip(toolTipOf(action->text()));
    });
  }
  masker_ = new Masker(session_, jobs_, this);
  for (QAction* action : {masker_->tableAction(), masker_->resetAction()})
    actions_[action->objectName()] = action;
}

void MainWindow::makeSceneToolActions() {
  sceneTools_ = new QActionGroup(this);
  for (const Tool* tool : chosenSceneTools()) {
    auto* action = new QAction(tool->text, sceneTools_);
    action->setObjectName(QLatin1String(tool->name) + QStringLiteral("Tool"));
    action->setShortcut(tool->key);
    action->setCheckable(true);
    action->setChecked(tool == &toolNamed("rotate"));
    action->setProperty("iconName", QLatin1String(tool->name));
    connect(action, &QAction::triggered, this, [this, tool] { grid_->setSceneTool(*tool); });
    addAction(action);
    actions_[action->objectName()] = action;
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
