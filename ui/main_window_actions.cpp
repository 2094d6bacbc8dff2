#include <QActionGroup>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QScrollArea>
#include <QSettings>
#include <QToolBar>

#include "ui/controller/table_remover.h"
#include "ui/main_window.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/camera_panel.h"
#include "ui/panels/clip_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/segment_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/canvas.h"
#include "ui/views/volume_view.h"

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

// A panel that may be given less height than it has, so that the window fits a small screen.
QWidget* scrolling(QWidget* panel) {
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setMinimumWidth(panel->minimumSizeHint().width());
  scroll->setWidget(panel);
  return scroll;
}

}  // namespace

void MainWindow::addDock(const QString& name, const QString& title, QWidget* panel, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title);
  dock->setObjectName(name + QStringLiteral("Dock"));
  panel->setObjectName(name + QStringLiteral("Panel"));
  dock->setWidget(panel);
  addDockWidget(area, dock);
  docks_[name] = dock;
}

void MainWindow::makeDocks() {
  studies_ = new StudiesPanel;
  effects_ = new EffectsPanel;
  accuracy_ = new AccuracyPanel(session_);
  snapshotPanel_ = new SnapshotPanel;
  segment_ = new SegmentPanel(session_);
  auto* camera = new CameraPanel(session_, [this] { return view_->camera(); });
  connect(camera, &CameraPanel::viewRequested, view_, &VolumeView::showView);
  connect(camera, &CameraPanel::resetRequested, view_, &VolumeView::resetView);
  const auto left = Qt::LeftDockWidgetArea, right = Qt::RightDockWidgetArea;
  addDock(QStringLiteral("studies"), tr("Studies"), studies_, left);
  addDock(QStringLiteral("transfer"), tr("Opacity and colour"), new TransferPanel(session_), right);
  addDock(QStringLiteral("lights"), tr("Lights"), scrolling(new LightsPanel(session_)), right);
  addDock(QStringLiteral("material"), tr("Material"), scrolling(new MaterialPanel(session_)), right);
  addDock(QStringLiteral("clip"), tr("Clip"), scrolling(new ClipPanel(session_)), right);
  addDock(QStringLiteral("camera"), tr("Camera"), scrolling(camera), right);
  addDock(QStringLiteral("effects"), tr("Effects"), effects_, right);
  addDock(QStringLiteral("accuracy"), tr("Accuracy and time"), scrolling(accuracy_), right);
  addDock(QStringLiteral("segment"), tr("Segment"), scrolling(segment_), right);
  addDock(QStringLiteral("snapshot"), tr("Snapshot"), scrolling(snapshotPanel_), right);
  const auto dock = [this](const char* name) { return docks_.at(QLatin1String(name)); };
  for (const char* name : {"material", "clip", "camera", "segment"})
    tabifyDockWidget(dock("lights"), dock(name));
  for (const char* name : {"accuracy", "snapshot"}) tabifyDockWidget(dock("effects"), dock(name));
  dock("lights")->raise();
  dock("effects")->raise();
  resizeDocks({dock("studies"), dock("transfer")}, {230, 340}, Qt::Horizontal);
  resizeDocks({dock("transfer"), dock("lights"), dock("effects")}, {280, 160, 340}, Qt::Vertical);
}

void MainWindow::makeActions() {
  const auto keypad = [](int key) { return QKeySequence(int(Qt::KeypadModifier) | key); };
  const auto opposite = [](int key) {
    return QKeySequence(int(Qt::KeypadModifier) | int(Qt::ControlModifier) | key);
  };
  const auto view = [this](const char* name) {
    return [this, name](bool) { view_->showView(QLatin1String(name)); };
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
      {"snapshot",
       tr("Save picture..."),
       {tr("Ctrl+S")},
       "snapshot",
       false,
       [this](bool) { snapshotPanel_->askWhere(); }},
      {"quit", tr("Quit"), {QKeySequence::Quit}, "", false, [this](bool) { close(); }},
      {"orbitTool",
       tr("Turn the view"),
       {tr("T")},
       "orbit",
       true,
       [this](bool) { view_->setTool(ViewTool::orbit); }},
      {"curveTool",
       tr("Shift the curve"),
       {tr("W")},
       "curve",
       true,
       [this](bool) { view_->setTool(ViewTool::curve); }},
      {"resetView", tr("Reset the view"), {tr("R")}, "reset", false, [this](bool) { view_->resetView(); }},
      {"viewAnterior", tr("From anterior"), {keypad(Qt::Key_1)}, "view", false, view("anterior")},
      {"viewPosterior", tr("From posterior"), {opposite(Qt::Key_1)}, "", false, view("posterior")},
      {"viewLeft", tr("From left"), {keypad(Qt::Key_3)}, "", false, view("left")},
      {"viewRight", tr("From right"), {opposite(Qt::Key_3)}, "", false, view("right")},
      {"viewSuperior", tr("From superior"), {keypad(Qt::Key_7)}, "", false, view("superior")},
      {"viewInferior", tr("From inferior"), {opposite(Qt::Key_7)}, "", false, view("inferior")},
      {"maximise", tr("View alone"), {tr("F10")}, "", true, [this](bool on) { setMaximised(on); }},
      {"fullScreen",
       tr("Full screen"),
       {tr("F11")},
       "",
       true,
       [this](bool on) {
         setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
       }},
      {"openGlResampler",
       tr("Resample with OpenGL"),
       {},
       "",
       true,
       [this](bool on) { setResampler(on ? Resampler::gl : Resampler::cpu); }},
      {"showError", tr("Show error"), {}, "", true, [](bool) {}},
      {"lightTheme",
       tr("Light theme"),
       {},
       "",
       true,
       [this](bool on) { setTheme(on ? Theme::light : Theme::dark); }},
      {"shortcuts", tr("Mouse and keys"), {tr("?")}, "help", false, [this](bool) { showShortcuts(); }},
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
  for (const char* tool : {"orbitTool", "curveTool"}) tools->addAction(actions_[QLatin1String(tool)]);
  actions_[QStringLiteral("orbitTool")]->setChecked(true);
  for (auto [name, action, key] :
       {std::tuple("undo", session_.undoStack().createUndoAction(this, tr("Undo")), QKeySequence::Undo),
        std::tuple("redo", session_.undoStack().createRedoAction(this, tr("Redo")), QKeySequence::Redo)}) {
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(key);
    action->setProperty("iconName", QLatin1String(name));
    actions_[action->objectName()] = action;
  }
  tableRemover_ = new TableRemover(session_, this);
  actions_[tableRemover_->objectName()] = tableRemover_;
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, const char* names) {
    for (const QString& name : QString::fromLatin1(names).split(QLatin1Char(' ')))
      if (name == QStringLiteral("|"))
        menu->addSeparator();
      else
        menu->addAction(actions_.at(name));
  };
  fill(menuBar()->addMenu(tr("&File")), "openFolder openFile openSample | snapshot | quit");
  fill(menuBar()->addMenu(tr("&Edit")), "undo redo | removeTable");
  auto* view = menuBar()->addMenu(tr("&View"));
  fill(view,
       "orbitTool curveTool resetView | viewAnterior viewPosterior viewLeft viewRight viewSuperior "
       "viewInferior | "
       "openGlResampler showError | maximise fullScreen lightTheme");
  auto* docks = view->addMenu(tr("Panels"));
  for (const auto& [name, dock] : docks_) docks->addAction(dock->toggleViewAction());
  fill(menuBar()->addMenu(tr("&Help")), "shortcuts about");
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({22, 22});
  const auto add = [&](const char* name) { bar->addAction(actions_.at(QLatin1String(name))); };
  for (const char* name : {"openFolder", "undo", "redo"}) add(name);
  bar->addSeparator();
  for (const char* name : {"orbitTool", "curveTool", "resetView"}) add(name);
  bar->addSeparator();
  auto* label = new QLabel(tr("Preset"));
  presets_ = new QComboBox;
  presets_->setObjectName(QStringLiteral("presets"));
  presets_->setAccessibleName(tr("Preset"));
  presets_->setMinimumContentsLength(22);
  presets_->addItem(tr("automatic"), QStringLiteral("auto"));
  for (const std::string& name : services_.presetNames)
    presets_->addItem(QString::fromStdString(name), QString::fromStdString(name));
  label->setBuddy(presets_);
  bar->addWidget(label);
  bar->addWidget(presets_);
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  add("snapshot");
  add("shortcuts");
  connect(presets_, &QComboBox::activated, this, [this](int n) {
    if (session_.series()) loader_.makePreset(presets_->itemData(n).toString(), session_.series()->volume);
  });
}

void MainWindow::askForFolder() {
  auto* dialog = new QFileDialog(this, tr("Open a folder"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { open({path}); });
  dialog->open();
}

void MainWindow::askForFile() {
  auto* dialog = new QFileDialog(this, tr("Open files"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  connect(dialog, &QFileDialog::filesSelected, this, &MainWindow::open);
  dialog->open();
}

void MainWindow::setTheme(Theme theme) {
  applyTheme(*qApp, theme);
  QSettings().setValue(QStringLiteral("theme"),
                       theme == Theme::light ? QStringLiteral("light") : QStringLiteral("dark"));
  for (const auto& [name, action] : actions_) {
    const QString iconName = action->property("iconName").toString();
    if (!iconName.isEmpty()) action->setIcon(icon(iconName));
  }
}

void MainWindow::showAbout() {
  auto* box = new QMessageBox(
      QMessageBox::NoIcon, tr("About volumen"),
      tr("<h3>volumen %1</h3><p>A DICOM workstation for people without a GPU to spare.</p>"
         "<p><b>Not for clinical use.</b></p>"
         "<p>Free software under the GNU General Public License, version 3 or later.</p>"
         "<p>Qt %2. Pictures are shown through: %3.</p>")
          .arg(QStringLiteral(VOLUMEN_VERSION), QLatin1String(qVersion()), canvasKind(view_->canvas())),
      QMessageBox::Close, this);
  box->setObjectName(QStringLiteral("aboutBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setModal(false);
  box->show();
}

void MainWindow::showShortcuts() {
  const QStringList rows{
      tr("Left drag"),
      tr("turn about the point under the cursor (Ctrl: roll)"),
      tr("Middle or Shift+left drag"),
      tr("move"),
      tr("Right drag, wheel"),
      tr("zoom at the cursor"),
      tr("Double-click"),
      tr("view alone and back"),
      tr("Arrows"),
      tr("turn by 5 degrees (Shift: 1)"),
      tr("R"),
      tr("reset the view"),
      tr("Keypad 1, 3, 7"),
      tr("from anterior, left, superior (Ctrl: the opposite)"),
      tr("W, T"),
      tr("drag shifts (up, down) and widens (left, right) the curve (Ctrl: overall opacity); back to "
         "turning"),
      tr("Curve"),
      tr("double-click adds, right-click or Delete removes, arrows nudge, Tab walks, wheel zooms the axis, "
         "Home shows all"),
      tr("Ctrl+Z, Ctrl+Shift+Z"),
      tr("undo, redo"),
      tr("Ctrl+O, Ctrl+S"),
      tr("open a folder, save a picture"),
  };
  QString html = QStringLiteral("<table cellpadding='3' width='560'>");
  for (int n = 0; n + 1 < rows.size(); n += 2)
    html += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>").arg(rows[n], rows[n + 1]);
  auto* box = new QMessageBox(QMessageBox::NoIcon, tr("Mouse and keys"), html + QStringLiteral("</table>"),
                              QMessageBox::Close, this);
  box->setObjectName(QStringLiteral("shortcutsBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setModal(false);
  box->show();
}

}  // namespace volumen
