#include "ui/panels/study_browser.h"

#include <QDragEnterEvent>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QTreeView>
#include <algorithm>

#include "ui/panels/series_strip.h"
#include "ui/panels/study_columns.h"
#include "ui/widgets/fields.h"
#include "ui/workspace/dropped_files.h"

namespace volumen {

namespace {

constexpr int askAfterMs = 60, askRemoteAfterMs = 800;  // delay after the last key
constexpr int sayBusyAfterMs = 300;

bool isReturn(const QKeyEvent& event) {
  return event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
}

}  // namespace

StudyBrowser::StudyBrowser(StudySources& sources, QWidget* parent)
    : QWidget(parent),
      sources_(sources),
      model_(new StudyModel(this)),
      sourceBox_(choiceField({QStringLiteral("browserSource"), tr("Where studies are listed from")})),
      search_(new QLineEdit),
      import_(buttonOf<QPushButton>(QStringLiteral("browserImport"), tr("Import folder..."),
                                    [this] { Q_EMIT importRequested(); })),
      tree_(new QTreeView),
      strip_(new SeriesStrip),
      notice_(wrappedLabel(QStringLiteral("browserNotice"))),
      removedBar_(new QFrame),
      removedText_(wrappedLabel(QStringLiteral("removedText"))),
      undo_(buttonOf<QPushButton>(QStringLiteral("undoRemove"), tr("Undo"))) {
  setObjectName(QStringLiteral("studyBrowser"));
  setAcceptDrops(true);
  notice_->hide();
  makeSourceBox();
  makeTree();
  makeRemovedBar();
  stack(this, {searchRow(), notice_, {tree_, 1}, strip_, removedBar_}, 8, 6);
  for (QWidget* watched :
       {static_cast<QWidget*>(search_), static_cast<QWidget*>(tree_), static_cast<QWidget*>(strip_)})
    watched->installEventFilter(this);
  ask_.setSingleShot(true);
  sayBusy_.setSingleShot(true);
  sayBusy_.setInterval(sayBusyAfterMs);
  connect(&sayBusy_, &QTimer::timeout, this,
          [this] { showNotice(tr("Searching %1...").arg(sources_.current().name())); });
  connect(&ask_, &QTimer::timeout, this, &StudyBrowser::ask);
  connect(search_, &QLineEdit::textChanged, &ask_, qOverload<>(&QTimer::start));
  connect(model_, &StudyModel::seriesWanted, this,
          [this](qint64 study) { sources_.current().series(study); });
  connect(strip_, &SeriesStrip::thumbnailsWanted, this,
          [this](const std::vector<std::int64_t>& series) { sources_.current().wantThumbnails(series); });
  model_->setKept([this](const std::string& studyUid) { return sources_.isKept(studyUid) == true; });
  connect(&sources_, &StudySources::chosen, this, &StudyBrowser::showSource);
  connect(&sources_, &StudySources::offeredChanged, this, &StudyBrowser::showSources);
  showSources();
  listen();
  setFocusProxy(tree_);
  setTabOrder(search_, tree_);
  setTabOrder(tree_, strip_);
}

// Listens to the current source only.
void StudyBrowser::listen() {
  listening_ = std::make_unique<QObject>();
  StudySource* source = &sources_.current();
  connect(source, &StudySource::listed, listening_.get(),
          [this](const StudyListRequest& request, const StudyListPtr& list) { showList(request, list); });
  connect(source, &StudySource::changed, listening_.get(), [this] { ask_.start(); });
  connect(source, &StudySource::unavailable, listening_.get(),
          [this](const QString& sentence) { showUnavailable(sentence); });
  connect(source, &StudySource::seriesListed, listening_.get(),
          [this](qint64 study, const SeriesListPtr& series) {
            model_->setSeries(study, series);
            if (study == strip_->study()) strip_->showStudy(study, series);
          });
  connect(source, &StudySource::thumbnailMade, listening_.get(),
          [this](qint64 series, const QImage& thumbnail) { strip_->setThumbnail(series, thumbnail); });
  model_->setSource(source->key());
  strip_->setSource(source->key());
  import_->setVisible(source->canImport());
  showPlaces(source->isOfOthers());
  ask_.setInterval(source->isRemote() ? askRemoteAfterMs : askAfterMs);
  search_->setPlaceholderText(source->isRemote()
                                  ? tr("Search by name, ID, accession number, date, modality or description")
                                  : tr("Search by name, ID, date, institution, modality or description"));
}

void StudyBrowser::showPlaces(bool on) {
  constexpr int column = int(StudyColumn::place);
  tree_->setColumnHidden(column, !on);
  if (!on && sort_.by == StudyColumn::place)
    tree_->header()->setSortIndicator(int(StudyColumn::date), Qt::DescendingOrder);
}

// Clears everything that belongs to the previous source.
void StudyBrowser::showSource() {
  listen();
  setUsable(true);
  model_->setList(std::make_shared<const StudyList>(), sort_);
  strip_->showStudy(0, nullptr);
  showNotice({});
  removedBar_->hide();
  removed_.clear();
  ask();
}

void StudyBrowser::refresh() { ask(); }

void StudyBrowser::ask() {
  ask_.stop();
  asked_ = {search_->text().trimmed().toStdString(), sort_};
  if (sources_.current().isRemote())
    sayBusy_.start();
  else
    sayBusy_.stop();
  sources_.current().list(asked_);
}

// An archive may answer later, and has no studies for other words until then.
void StudyBrowser::showUnavailable(const QString& sentence) {
  sayBusy_.stop();
  if (!sources_.current().isRemote()) {
    setUsable(false);
    return showNotice(tr("The list of studies cannot be used: %1").arg(sentence));
  }
  model_->setList(std::make_shared<const StudyList>(), sort_);
  strip_->showStudy(0, nullptr);
  showNotice(sentence);
}

// Restores selection and expanded rows, and expands a short list. Ignores answers to outdated requests.
void StudyBrowser::showList(const StudyListRequest& request, const StudyListPtr& list) {
  if (request != asked_) return;
  sayBusy_.stop();
  setUsable(true);
  const TreeState before = treeState(std::exchange(shown_, request).words == request.words);
  model_->setList(list, request.sort);
  restore(before);
  showSeriesOf(tree_->currentIndex());
  showNotice(noticeOn(*list));
  Q_EMIT listChanged();
}

QString StudyBrowser::noticeOn(const StudyList& list) const {
  if (!list.notice.isEmpty() || !list.patients.empty() || list.isGrowing) return list.notice;
  if (!shown_.words.empty()) return tr("No study has all of these words.");
  if (!sources_.current().canImport()) return tr("There are no studies here.");
  return tr(
      "No studies yet. Import a folder, or drop one here: it is read into this list, and the files stay "
      "where they are.");
}

void StudyBrowser::setUsable(bool usable) {
  search_->setEnabled(usable);
  tree_->setEnabled(usable);
  strip_->setEnabled(usable);
}

// Shows the series of a patient's latest study, or of the first study of the recent group.
void StudyBrowser::showSeriesOf(const QModelIndex& index) {
  const IndexedStudy* study = model_->studyAt(model_->latestOf(index));
  if (!study && index.isValid()) study = model_->studyAt(model_->index(0, 0, index.siblingAtColumn(0)));
  if (!study) return strip_->showStudy(0, nullptr);
  if (study->id == strip_->study()) return;
  strip_->showStudy(study->id, nullptr);
  sources_.current().series(study->id);
}

void StudyBrowser::showNotice(const QString& sentence) {
  notice_->setText(sentence);
  notice_->setVisible(!sentence.isEmpty());
}

void StudyBrowser::showNames() {
  model_->showNames();
  strip_->showNames();
}

void StudyBrowser::startSearch() {
  search_->setFocus();
  search_->selectAll();
}

void StudyBrowser::clearSearch() { search_->clear(); }

// A group can only be expanded and collapsed.
void StudyBrowser::activate(const QModelIndex& index) {
  if (model_->isRecentGroup(index)) return tree_->setExpanded(index, !tree_->isExpanded(index));
  openBest(index, false);
}

void StudyBrowser::open(const IndexedChoice& choice, bool isOffline, bool beside) {
  if (choice.study == 0) return;
  if (isOffline) return Q_EMIT offlineRequested();
  Q_EMIT openRequested(choice, beside);
}

void StudyBrowser::openCurrent(bool beside) { openBest(tree_->currentIndex(), beside); }

// Opens the latest study of a patient, or the first of the recent group.
void StudyBrowser::openBest(const QModelIndex& row, bool beside) {
  QModelIndex index = model_->latestOf(row.siblingAtColumn(0));
  if (!model_->studyAt(index) && index.isValid()) index = model_->index(0, 0, index);
  if (const IndexedStudy* study = model_->studyAt(index)) {
    const IndexedSeries* series = model_->seriesAt(index);
    open(model_->choiceAt(index), series ? series->offline : study->offline, beside);
  }
}

void StudyBrowser::removeChosen() {
  if (!sources_.current().canRemove()) return;
  std::vector<std::int64_t> studies;
  for (const QModelIndex& index : tree_->selectionModel()->selectedRows())
    for (const std::int64_t study : model_->studiesOf(index))
      if (std::ranges::find(studies, study) == studies.end()) studies.push_back(study);
  undo_->setVisible(!studies.empty());
  removedBar_->show();
  if (studies.empty())
    return removedText_->setText(tr("Choose a study or a patient to remove from the list."));
  removedText_->setText(
      studies.size() == 1
          ? tr("1 study removed from the list. Its files stay where they are.")
          : tr("%1 studies removed from the list. Their files stay where they are.").arg(studies.size()));
  removed_ = studies;
  sources_.current().remove(studies);
}

void StudyBrowser::showMenu(QWidget* from, QPoint position) {
  const QListWidgetItem* item = from == strip_ ? strip_->itemAt(position) : nullptr;
  const QModelIndex index = from == tree_ ? tree_->indexAt(position).siblingAtColumn(0) : QModelIndex();
  const IndexedSeries* series = item ? strip_->seriesOf(item) : model_->seriesAt(index);
  const IndexedChoice choice = item ? strip_->choiceOf(item) : model_->choiceAt(index);
  if (!item && !index.isValid()) return;
  const IndexedStudy* study = model_->studyAt(index);
  const bool isOffline = series ? series->offline : study && study->offline;
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("browserMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (choice.study != 0)
    for (const bool beside : {false, true})
      menu->addAction(beside ? tr("Open beside") : tr("Open"), this,
                      [this, choice, isOffline, beside] { open(choice, isOffline, beside); });
  addSending(menu, choice, series);
  addKeeping(menu, choice);
  if (sources_.current().canRemove() && !model_->studiesOf(index).empty())
    menu->addAction(tr("Remove from list"), this, &StudyBrowser::removeChosen);
  if (from == tree_) columns_->addTo(menu->addMenu(tr("Columns")));
  if (menu->isEmpty()) return menu->deleteLater();
  menu->popup(from->mapToGlobal(position));
}

bool StudyBrowser::eventFilter(QObject* watched, QEvent* event) {
  const bool isPress = event->type() == QEvent::KeyPress;
  if (!isPress && event->type() != QEvent::ShortcutOverride) return QWidget::eventFilter(watched, event);
  auto* key = static_cast<QKeyEvent*>(event);
  return watched == search_ ? isPress && searchKey(key) : listKey(watched, key, isPress);
}

bool StudyBrowser::searchKey(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && !search_->text().isEmpty()) {
    search_->clear();
    return true;
  }
  if (event->key() == Qt::Key_Down) {
    tree_->setFocus();
    return true;
  }
  if (!isReturn(*event)) return false;
  if (sources_.current().isRemote()) return ask(), true;  // what is listed may be of other words
  openCurrent(event->modifiers() & Qt::ControlModifier);
  return true;
}

// Handles keys pressed in a list and moves typed text to the search. Returns true for keys that must not
// trigger shortcuts of the window.
bool StudyBrowser::listKey(QObject* watched, QKeyEvent* event, bool isPress) {
  const bool hasModifier = event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
  const bool isTyped = !hasModifier && !event->text().isEmpty() && event->text().front().isPrint() &&
                       !event->text().front().isSpace();
  const bool isBeside = isReturn(*event) && event->modifiers() & Qt::ControlModifier;
  const bool isOwn = isTyped || isBeside || event->key() == Qt::Key_Escape || event->key() == Qt::Key_Delete;
  if (!isOwn) return false;
  event->accept();
  if (!isPress) return true;
  if (event->key() == Qt::Key_Escape)
    search_->clear();
  else if (event->key() == Qt::Key_Delete && watched == tree_)
    removeChosen();
  else if (isBeside && watched == strip_)
    open(strip_->choiceOf(strip_->currentItem()), false, true);
  else if (isBeside)
    openCurrent(true);
  else if (isTyped) {
    search_->setFocus();
    search_->insert(event->text());
  }
  return true;
}

// Imports files dropped on the list. Files dropped elsewhere are opened.
void StudyBrowser::dragEnterEvent(QDragEnterEvent* event) {
  const bool canImport = sources_.current().canImport();
  if (canImport && !localFiles(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void StudyBrowser::dropEvent(QDropEvent* event) {
  sources_.current().import(localFiles(*event->mimeData()));
  event->acceptProposedAction();
}

}  // namespace volumen
