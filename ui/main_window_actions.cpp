#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/controller/masker.h"
#include "ui/main_window.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/camera_panel.h"
#include "ui/panels/clip_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/link_menu.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/measurements_panel.h"
#include "ui/panels/preset_bar.h"
#include "ui/panels/segment_panel.h"
#include "ui/panels/slab_menu.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/documents_window.h"
#include "ui/widgets/fold_title.h"
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
  studies_ = new StudiesPanel;
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
      {"orbitTool",
       tr("Rotate"),
       {tr("T")},
       "orbit",
       true,
       [this](bool) { grid_->setTool(ViewTool::orbit); }},
      {"curveTool",
       tr("Adjust curve (W/L)"),
       {tr("W")},
       "curve",
       true,
       [this](bool) { grid_->setTool(ViewTool::curve); }},
      {"scissorsTool",
       tr("Scissors"),
       {tr("X")},
       "scissors",
       true,
       [this](bool) { grid_->setTool(ViewTool::scissors); }},
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
  auto* tools = new QActionGroup(this);
  for (const char* tool : {"orbitTool", "curveTool", "scissorsTool"})
    tools->addAction(actions_[QLatin1String(tool)]);
  actions_[QStringLiteral("orbitTool")]->setChecked(true);
  actions_[QStringLiteral("leaveMaximised")]->setEnabled(false);
  for (auto [name, action, key] :
       {std::tuple("undo", session_.undoStack().createUndoAction(this, tr("Undo")), QKeySequence::Undo),
        std::tuple("redo", session_.undoStack().createRedoAction(this, tr("Redo")), QKeySequence::Redo)}) {
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(key);
    action->setProperty("iconName", QLatin1String(name));
    actions_[action->objectName()] = action;
  }
  masker_ = new Masker(session_, this);
  for (QAction* action : {masker_->tableAction(), masker_->resetAction()})
    actions_[action->objectName()] = action;
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, const char* names) {
    for (const QString& name : QString::fromLatin1(names).split(QLatin1Char(' ')))
      if (name == QStringLiteral("|"))
        menu->addSeparator();
      else
        menu->addAction(actions_.at(name));
  };
  auto* file = menuBar()->addMenu(tr("&File"));
  fill(file,
       "openFolder openFile openSample | showBrowser findStudy importFolder | openSession saveSession "
       "saveSessionAs | openScene saveScene | "
       "snapshot copySnapshot | quit");
  recentMenu_ = new QMenu(tr("Open recent"), file);
  file->insertMenu(actions_.at(QStringLiteral("openSample")), recentMenu_);
  connect(file, &QMenu::aboutToShow, &recent_, &RecentFiles::look);
  fill(menuBar()->addMenu(tr("&Edit")), "undo redo | removeTable resetScissors | preferences");
  auto* view = menuBar()->addMenu(tr("&View"));
  fill(view,
       "orbitTool curveTool scissorsTool resetView | viewAnterior viewPosterior viewLeft viewRight "
       "viewSuperior "
       "viewInferior | "
       "showAsFrames overlaysAndShutters playFrames | "
       "keyImage previousKeyImage nextKeyImage | "
       "openGlResampler showError | maximise fullScreen lightTheme hideNames");
  layoutMenu_ = view->addMenu(tr("Layout"));
  auto* shown = view->addMenu(tr("Show in this view"));
  shown->addActions(kinds_->actions());
  fill(layoutMenu_, "layoutOne layoutPlanes layoutBesidePlanes layoutTwo layoutFour | alignPlanes");
  linkMenu_ = makeLinkMenu(
      session_, [this] { registerViews(); }, view);
  view->addMenu(linkMenu_);
  view->addMenu(measureMenu_);
  view->addAction(actions_.at(QStringLiteral("interpolate")));
  view->addMenu(makeSlabMenu(session_, view));
  view->addMenu(makeColourMenu(session_, view));
  view->addMenu(makeOverlayMenu(
      session_, [this] { return studies_->listedSeries(); }, view));
  auto* docks = view->addMenu(tr("Panels"));
  for (const auto& [name, dock] : docks_) docks->addAction(dock->toggleViewAction());
  docks->addSeparator();
  docks->addAction(actions_.at(QStringLiteral("resetLayout")));
  fill(menuBar()->addMenu(tr("&Help")), "documentation shortcuts about");
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({22, 22});
  const auto add = [&](const char* name) { bar->addAction(actions_.at(QLatin1String(name))); };
  for (const char* name : {"openFolder", "showBrowser", "undo", "redo"}) add(name);
  bar->addSeparator();
  for (const char* name : {"orbitTool", "curveTool", "scissorsTool", "resetView"}) add(name);
  bar->addSeparator();
  makePresetBar(bar);
  auto* layouts = new QToolButton;
  layouts->setObjectName(QStringLiteral("layoutButton"));
  layouts->setText(tr("Layout"));
  layouts->setPopupMode(QToolButton::InstantPopup);
  layouts->setMenu(layoutMenu_);
  bar->addWidget(layouts);
  bar->addWidget(makeMeasureButton());
  auto* links = new QToolButton;
  links->setObjectName(QStringLiteral("linkButton"));
  links->setDefaultAction(linkMenu_->menuAction());
  links->setPopupMode(QToolButton::InstantPopup);
  bar->addWidget(links);
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  add("snapshot");
  add("shortcuts");
}

void MainWindow::makePresetBar(QToolBar* bar) {
  presets_ = new PresetBar(session_, services_.presets);
  bar->addWidget(presets_);
  connect(presets_, &PresetBar::presetChosen, this,
          [this](const QString& name) { loader_.makePreset(name, session_.series()->volume); });
  connect(presets_, &PresetBar::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
  connect(presets_, &PresetBar::listChanged, this, [this] {
    thumbnailsOf_.reset();
    drawThumbnails();
  });
  QStringList problems;
  for (const std::string& problem : ownPresets().problems) problems << shownText(problem);
  if (!problems.isEmpty()) banner_->tell(tr("A preset of yours cannot be read."), problems);
  connect(&thumbnails_, &PresetThumbnails::ready, presets_, &PresetBar::showThumbnail);
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
