#include <QDir>
#include <QDropEvent>
#include <QFileInfo>
#include <QMenu>

#include "io/export/read_segments.h"
#include "io/files/session_file.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/path_dialog.h"
#include "ui/workspace/dropped_files.h"

namespace volumen {

namespace {

// Opens files and folders by dialog, drop and the list of recent files. Puts what was read into the list and
// the views, and reports failures.
class Opening : public Feature {
 public:
  explicit Opening(Workbench& bench);

  bool eventFilter(QObject* window, QEvent* event) override;

 private:
  void makeActions();
  void open(const QStringList& paths, const std::optional<Scene>& scene);
  void openFor(const QStringList& paths, OpenIntent intent);
  void takeDropped(const QStringList& paths, const QWidget* under);
  void ask(const QString& title, QFileDialog::FileMode mode);
  void showRecent();
  void showStudy(const QString& path, const std::shared_ptr<const Study>& study, const OpenIntent& intent);

  QMenu* recentMenu_;
};

Opening::Opening(Workbench& bench) : Feature(bench) {
  makeActions();
  RecentFiles& recent = bench_.document.recent;
  recentMenu_ = bench_.addMenu("recentMenu", tr("Open recent"), {{"fileMenu", 10, 10}});
  connect(bench_.menus.file(), &QMenu::aboutToShow, &recent, &RecentFiles::look);
  connect(&recent, &RecentFiles::changed, this, &Opening::showRecent);
  showRecent();
  connect(&bench_, &Workbench::openRequested, this, &Opening::open);
  const Loader* loader = &bench_.document.loader;
  connect(loader, &Loader::studyOpened, this, &Opening::showStudy);
  connect(loader, &Loader::failed, this, [this](const QString& sentence) { bench_.banner.add(sentence); });
  connect(loader, &Loader::notLoaded, &grid_, &ViewGrid::giveUpWaiting);
  for (QWidget* window :
       {static_cast<QWidget*>(&bench_.window), static_cast<QWidget*>(&grid_.secondWindow())}) {
    window->setAcceptDrops(true);
    window->installEventFilter(this);
  }
}

void Opening::makeActions() {
  bench_.shared.openFolder =
      bench_.addAction({"openFolder",
                        tr("Open folder..."),
                        {QKeySequence::Open},
                        "open",
                        false,
                        [this](bool) { ask(tr("Open folder"), QFileDialog::Directory); },
                        {{"fileMenu", 10}, {"toolBar", 10}}});
  bench_.shared.openFile =
      bench_.addAction({"openFile",
                        tr("Open file..."),
                        {tr("Ctrl+Shift+O")},
                        "",
                        false,
                        [this](bool) { ask(tr("Open file"), QFileDialog::ExistingFiles); },
                        {{"fileMenu", 10}}});
  bench_.shared.openSample =
      bench_.addAction({"openSample",
                        tr("Sample study"),
                        {},
                        "sample",
                        false,
                        [this](bool) { open({QStringLiteral("phantom:ct-head")}, {}); },
                        {{"fileMenu", 10, 20}}});
}

void Opening::open(const QStringList& paths, const std::optional<Scene>& scene) {
  OpenIntent intent;
  intent.scene = scene;
  openFor(paths, intent);
}

void Opening::openFor(const QStringList& paths, OpenIntent intent) {
  bench_.banner.hide();
  intent.isShown = std::make_shared<bool>(false);
  intent.isAlone = paths.size() == 1;
  for (const QString& given : paths) {
    const bool isFile = QFileInfo::exists(given);  // a phantom is no file
    const QString path = isFile ? QDir::cleanPath(QFileInfo(given).absoluteFilePath()) : given;
    if (isSessionFile(path.toStdString()))
      bench_.document.loader.openSession(path);
    else
      bench_.document.loader.open(path, intent);
  }
}

void Opening::ask(const QString& title, QFileDialog::FileMode mode) {
  connect(openPathDialog(bench_.dialogParent(), {"openDialog", title, {}, {}, mode}),
          &QFileDialog::filesSelected, this, [this](const QStringList& paths) { open(paths, {}); });
}

void Opening::showRecent() {
  RecentFiles& recent = bench_.document.recent;
  recentMenu_->clear();
  recentMenu_->setEnabled(!recent.paths().isEmpty());
  for (const QString& path : recent.paths()) {
    const QString text = QString(path).replace(QLatin1Char('&'), QStringLiteral("&&"));
    recentMenu_->addAction(text, this, [this, path] { open({path}, {}); })->setEnabled(!recent.isGone(path));
  }
  recentMenu_->addSeparator();
  auto* clear = recentMenu_->addAction(tr("Clear list"));
  clear->setObjectName(QStringLiteral("clearRecentMenu"));
  connect(clear, &QAction::triggered, &recent, &RecentFiles::clear, Qt::QueuedConnection);
}

void Opening::showStudy(const QString& path, const std::shared_ptr<const Study>& study,
                        const OpenIntent& intent) {
  bench_.document.opener.list(path, study);
  QStringList details = refusedTexts(study->refused);
  for (const Other& other : study->other)
    details << pathText(other.path) + QStringLiteral(": ") + shownText(other.kind);
  const bool hasPictures = !study->volumes.empty() || !study->images.empty();
  if (!hasPictures && !study->derived.empty()) return;  // the list shows them
  if (!hasPictures)
    return bench_.banner.add(tr("No images found in %1.").arg(pathText(path.toStdString())), details);
  if (!study->refused.empty()) bench_.banner.add(unreadText(*study), details);
  bench_.document.recent.add(path);
  if (!intent.isShown) return;
  if (!std::exchange(*intent.isShown, true))
    bench_.document.opener.showFirst(*study, intent.scene);
  else if (!intent.scene)
    bench_.document.opener.showFused(*study);
}

// Imports files whose name marks them as segments into the series of the view under the pointer. Opens all
// others.
void Opening::takeDropped(const QStringList& paths, const QWidget* under) {
  while (under && !qobject_cast<const View*>(under)) under = under->parentWidget();
  const auto* view = qobject_cast<const View*>(under);
  OpenIntent intent;
  if (view && view->series()) intent.onto = view->id();
  QStringList segments, others;
  for (const QString& path : paths)
    (intent.onto && isNamedAsSegments(path.toStdString()) ? segments : others) << path;
  if (!others.isEmpty()) openFor(others, intent);
  if (segments.isEmpty()) return;
  session_.setFocus(view->id());
  Q_EMIT bench_.segmentsRequested(segments);
}

// Opens files in the window that they are dropped on.
bool Opening::eventFilter(QObject* window, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop)
    return Feature::eventFilter(window, event);
  auto* drop = static_cast<QDropEvent*>(event);
  if (event->type() == QEvent::DragEnter) {
    if (!localFiles(*drop->mimeData()).isEmpty()) drop->acceptProposedAction();
    return true;
  }
  const QStringList paths = localFiles(*drop->mimeData());
  const bool isSecond = window == &grid_.secondWindow();
  if (!paths.isEmpty() && isSecond != isInSecond(session_.workspace().focus))
    session_.setFocus(grid_.viewShownIn(isSecond)->id());
  takeDropped(paths, static_cast<QWidget*>(window)->childAt(drop->position().toPoint()));
  drop->acceptProposedAction();
  return true;
}

}  // namespace

std::unique_ptr<Feature> makeOpening(Workbench& bench) { return std::make_unique<Opening>(bench); }

}  // namespace volumen
