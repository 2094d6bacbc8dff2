#include "ui/panels/studies_panel.h"

#include <QDesktopServices>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QMouseEvent>
#include <QPersistentModelIndex>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QTreeWidgetItemIterator>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>
#include <utility>

#include "io/study/frame_series.h"
#include "io/thumbnail.h"
#include "results/pictures/readable_text.h"
#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/panels/studies_panel_roles.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/untinted_icon.h"
#include "ui/workspace/dragged_series.h"

namespace volumen {

namespace {

constexpr int thumbnailEdge = 44;
constexpr int leastWidth = 150;  // also after the window was narrow

// Keeps the dates at the head of studies; other names keep both ends.
class NameDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (!leadingDate(option->text).isEmpty()) option->textElideMode = Qt::ElideRight;
  }
};

QStringList linesOf(const Series& series, const std::vector<const Series*>& steps) {
  QStringList several{stepsText(steps), timeAxisText(steps)};
  several.removeDuplicates();
  return everythingOf(series) + several;
}

// Returns other series of the study with the same name.
std::vector<const Series*> namesakes(const Study& study, const Series& series) {
  std::vector<const Series*> found;
  for (const Series& other : study.volumes)
    if (areNamesakes(other, series) && !areTimePoints(other, series)) found.push_back(&other);
  return found;
}

// Returns whether the row of one series also stands for another one.
bool standsFor(const Series& listed, const Series& series) {
  return keyOf(listed) == keyOf(series) || (!opensAsFrames(listed) && areTimePoints(listed, series));
}

// A tree with draggable series. Drag data holds the opened path and the series' number in it, and its files
// for other programs.
class StudyTree : public QTreeWidget {
 public:
  explicit StudyTree(std::function<QStringList(const QMimeData&)> filesOf) : filesOf_(std::move(filesOf)) {}

 protected:
  // The first click has already chosen. A second choice would replace a fused view by the PET alone.
  void mouseDoubleClickEvent(QMouseEvent* event) override {
    const QSignalBlocker quiet(this);
    QTreeWidget::mouseDoubleClickEvent(event);
  }
  QStringList mimeTypes() const override { return {draggedSeriesType}; }
  QMimeData* mimeData(const QList<QTreeWidgetItem*>& items) const override {
    if (items.isEmpty() || !items.front()->data(0, stepRole).isValid()) return nullptr;
    auto* dragged = new QMimeData;
    dragged->setData(draggedSeriesType, items.front()->data(0, stepRole).toByteArray() + ' ' +
                                            items.front()->data(0, pathRole).toString().toUtf8());
    QList<QUrl> urls;
    for (const QString& file : filesOf_(*dragged)) urls << QUrl::fromLocalFile(file);
    if (!urls.isEmpty()) dragged->setUrls(urls);
    return dragged;
  }

 private:
  const std::function<QStringList(const QMimeData&)> filesOf_;
};

// Removes an item with all parents that become empty.
void removeItem(QTreeWidgetItem* item) {
  while (item) {
    QTreeWidgetItem* parent = item->parent();
    delete item;
    item = parent && parent->childCount() == 0 ? parent : nullptr;
  }
}

}  // namespace

StudiesPanel::StudiesPanel(OpenStudies& studies, FrameService& frames, QWidget* parent)
    : QWidget(parent),
      studies_(studies),
      search_(new QLineEdit),
      tree_(new StudyTree([this](const QMimeData& dragged) { return draggedFiles(dragged); })),
      thumbnails_(thumbnailEdge, frames) {
  setMinimumWidth(leastWidth);
  search_->setObjectName(QStringLiteral("studySearch"));
  search_->setPlaceholderText(tr("Search"));
  search_->setAccessibleName(tr("Search patients, studies and series"));
  search_->setClearButtonEnabled(true);
  tree_->setObjectName(QStringLiteral("studyTree"));
  tree_->setAccessibleName(tr("Patients, studies and series"));
  tree_->setHeaderHidden(true);
  tree_->setItemDelegate(new NameDelegate(tree_));
  tree_->setTextElideMode(Qt::ElideMiddle);  // names of series differ at their ends
  tree_->setDragEnabled(true);
  tree_->setIndentation(8);
  tree_->setUniformRowHeights(false);
  tree_->setIconSize({thumbnailEdge, thumbnailEdge});
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(search_);
  column->addWidget(tree_, 1);
  connect(search_, &QLineEdit::textChanged, this, &StudiesPanel::filter);
  const auto choose = [this](QTreeWidgetItem* item) {
    if (const Series* series = seriesOf(item)) Q_EMIT seriesChosen(*series);
    if (const DerivedObjectPtr object = derivedObjectOf(item)) Q_EMIT objectChosen(object);
  };
  connect(tree_, &QTreeWidget::itemClicked, this, choose);
  connect(tree_, &QTreeWidget::itemActivated, this, choose);
  connect(tree_, &QTreeWidget::customContextMenuRequested, this, &StudiesPanel::showMenu);
  connect(&thumbnails_, &Thumbnails::made, this, &StudiesPanel::setThumbnail);
  connect(&studies_, &OpenStudies::added, this, &StudiesPanel::showStudy);
  connect(&studies_, &OpenStudies::unlistedChanged, this, &StudiesPanel::showUnlisted);
}

int StudiesPanel::fittingWidth() const {
  constexpr int levels = 3;   // patient, study, series
  constexpr int around = 24;  // gaps beside picture and text, and the frame
  QFont bold = tree_->font();
  bold.setBold(true);
  const int text =
      QFontMetrics(bold).horizontalAdvance(tr("%1 slices").arg(138) + QStringLiteral(", ") + tr("sagittal"));
  const QMargins margins = layout()->contentsMargins();
  return margins.left() + margins.right() + levels * tree_->indentation() + thumbnailEdge + around + text;
}

// Returns null for items that were not opened.
const OpenStudy* StudiesPanel::openedOf(const QTreeWidgetItem* item) const {
  return studies_.find(item->data(0, pathRole).toString());
}

// Returns null for patients, studies and unreadable files.
const Series* StudiesPanel::seriesOf(const QTreeWidgetItem* item) const {
  const QVariant step = item->data(0, stepRole);
  const OpenStudy* opened = step.isValid() ? openedOf(item) : nullptr;
  return opened ? opened->seriesAt(step.toULongLong()) : nullptr;
}

// Returns all series that a row stands for.
std::vector<const Series*> StudiesPanel::stepsOf(const QTreeWidgetItem* item) const {
  const Series* shown = seriesOf(item);
  if (!shown) return {};
  std::vector<const Series*> steps;
  const OpenStudy& opened = *openedOf(item);
  for (std::size_t n = 0; const Series* series = opened.seriesAt(n); ++n)
    if (standsFor(*shown, *series)) steps.push_back(series);
  return steps;
}

std::vector<const Series*> StudiesPanel::listedSeries() const {
  std::vector<const Series*> listed;
  for (QTreeWidgetItemIterator it(tree_); *it; ++it)
    if (const Series* series = seriesOf(*it); series && series->notVolume.empty()) listed.push_back(series);
  return listed;
}

const Series* StudiesPanel::seriesOf(const QMimeData& dragged) const {
  const QByteArray said = dragged.data(draggedSeriesType);
  const qsizetype space = said.indexOf(' ');
  const std::size_t n = said.left(std::max(qsizetype(0), space)).toULongLong();
  const OpenStudy* opened = studies_.find(QString::fromUtf8(said.mid(space + 1)));
  return opened ? opened->seriesAt(n) : nullptr;
}

QStringList StudiesPanel::draggedFiles(const QMimeData& dragged) const {
  const Series* series = dragsFiles_ ? seriesOf(dragged) : nullptr;
  QStringList files;
  if (!series) return files;
  for (const std::string& file : series->files)
    if (const QString path = QString::fromStdString(file); QFileInfo::exists(path)) files << path;
  files.removeDuplicates();
  return files;
}

QTreeWidgetItem* StudiesPanel::childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text) {
  for (int n = 0; n < parent->childCount(); ++n)
    if (parent->child(n)->data(0, keyRole).toString() == key) return parent->child(n);
  auto* item = new QTreeWidgetItem(parent, {text});
  item->setData(0, keyRole, key);
  item->setFlags(Qt::ItemIsEnabled);
  item->setExpanded(true);
  return item;
}

// Returns the study item of a series, creating it if necessary.
QTreeWidgetItem* StudiesPanel::studyItem(const Series& series) {
  QTreeWidgetItem* root = tree_->invisibleRootItem();
  if (series.format != "DICOM")
    return childNamed(root, QStringLiteral("files"),
                      series.format == "phantom" ? tr("Phantoms") : tr("Files"));
  const std::string key = "patient " + series.patientName + "\n" + series.patientId;
  QTreeWidgetItem* patient = childNamed(root, QString::fromStdString(key), patientText(series));
  return childNamed(patient, QString::fromStdString(series.studyUid), studyText(series));
}

void StudiesPanel::addSeries(const OpenStudy& opened, std::vector<std::size_t> row) {
  std::erase_if(row, [&](std::size_t n) { return !studies_.isListed(*opened.seriesAt(n)); });
  if (row.empty()) return;
  std::vector<const Series*> steps;
  for (const std::size_t n : row) steps.push_back(opened.seriesAt(n));
  const Series series = commonOf(steps);
  QTreeWidgetItem* parent = studyItem(series);
  QStringList details{stepsText(steps), slicesText(series)};
  details.removeAll(QString());
  details << tellingApart(series, namesakes(*opened.study, *steps.front()));
  // Warnings about a single slice as a volume do not apply to it as a frame.
  const QString mark = series.warnings.empty() || opensAsFrames(series) ? QString() : QStringLiteral("! ");
  auto* item = new QTreeWidgetItem(
      parent, {mark + seriesText(series) + QLatin1Char('\n') + details.join(QStringLiteral(", "))});
  item->setToolTip(0, toolTipOf(linesOf(series, steps)));
  item->setData(0, pathRole, opened.path);
  item->setData(0, stepRole, qulonglong(row.front()));
  QPixmap none(thumbnailEdge, thumbnailEdge);  // keeps the layout when the thumbnail arrives
  none.fill(Qt::transparent);
  item->setIcon(0, none);
  thumbnails_.request(*steps.front());
}

void StudiesPanel::setThumbnail(const Series& series, const QImage& thumbnail) {
  for (QTreeWidgetItemIterator it(tree_); *it; ++it)
    if (const Series* listed = seriesOf(*it); listed && standsFor(*listed, series))
      (*it)->setIcon(0, untintedIcon(thumbnail));
}

void StudiesPanel::showMenu(QPoint position) {
  QTreeWidgetItem* item = tree_->itemAt(position);
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("studyMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const Series* series = item ? seriesOf(item) : nullptr;
  // The item may be deleted while the menu is open.
  const QPersistentModelIndex index(tree_->indexAt(position));
  if (item)
    menu->addAction(tr("Remove from list"), this, [this, index] {
      if (QTreeWidgetItem* chosen = tree_->itemFromIndex(index)) remove(chosen);
    });
  if (tree_->topLevelItemCount() > 0) menu->addAction(tr("Close all"), this, &StudiesPanel::closeAll);
  if (series && series->format != "phantom") {
    menu->addSeparator();
    const QFileInfo place(QString::fromStdString(series->path));
    const QString folder = place.isDir() ? place.filePath() : place.absolutePath();
    menu->addAction(tr("Show in file manager"), this,
                    [folder] { QDesktopServices::openUrl(QUrl::fromLocalFile(folder)); });
  }
  if (series && series->format == "DICOM")
    menu->addAction(tr("DICOM attributes..."), this,
                    [this, chosen = *series] { Q_EMIT attributesRequested(chosen); });
  if (item) addObjectEntries(menu, derivedObjectOf(item));
  if (menu->isEmpty()) return menu->deleteLater();
  menu->popup(tree_->viewport()->mapToGlobal(position));
}

// Removes an item with its children and empty parents.
void StudiesPanel::remove(QTreeWidgetItem* item) {
  std::vector<SeriesKey> series;
  std::vector<DerivedKey> derived;
  const std::function<void(QTreeWidgetItem*)> collect = [&](QTreeWidgetItem* from) {
    for (const Series* step : stepsOf(from)) series.push_back(keyOf(*step));
    if (const DerivedObjectPtr object = derivedObjectOf(from)) derived.push_back(keyOf(*object));
    for (int n = 0; n < from->childCount(); ++n) collect(from->child(n));
  };
  collect(item);
  if (series.empty() && derived.empty()) return removeItem(item);  // an unreadable file
  Q_EMIT removeRequested(series, derived);
}

void StudiesPanel::closeAll() {
  thumbnails_.cancel();
  tree_->clear();
  studies_.forgetEmpty();
  Q_EMIT closeAllRequested(studies_.everything());
}

void StudiesPanel::showUnlisted(bool comesBack) {
  if (comesBack) return showNames();
  std::vector<QTreeWidgetItem*> gone;
  for (QTreeWidgetItemIterator it(tree_); *it; ++it) {
    const Series* series = seriesOf(*it);
    const DerivedObjectPtr object = derivedObjectOf(*it);
    if ((series && !studies_.isListed(*series)) || (object && !studies_.isListed(*object)))
      gone.push_back(*it);
  }
  for (QTreeWidgetItem* item : gone) removeItem(item);
  showDerivedObjects();
}

void StudiesPanel::addRefused(const QString& path, const Study& study) {
  if (study.refused.empty()) return;
  auto* parent = childNamed(tree_->invisibleRootItem(), QStringLiteral("refused"), tr("Could not be read"));
  parent->setExpanded(false);
  for (const Refused& refused : study.refused) {
    const QString name = pathText(refused.path), reason = shownText(refused.reason);
    auto* item = new QTreeWidgetItem(parent, {QFileInfo(name).fileName()});
    item->setToolTip(0, toolTipOf({name, reason}));
    item->setData(0, pathRole, path);
    item->setFlags(Qt::ItemIsEnabled);
  }
}

void StudiesPanel::removePath(const QString& path) {
  std::vector<QTreeWidgetItem*> gone;
  for (QTreeWidgetItemIterator it(tree_); *it; ++it)
    if ((*it)->data(0, pathRole).toString() == path) gone.push_back(*it);
  for (QTreeWidgetItem* item : gone) removeItem(item);
}

void StudiesPanel::showStudy(const QString& path) {
  removePath(path);
  const OpenStudy& opened = *studies_.find(path);
  for (const std::vector<std::size_t>& row : opened.rows()) addSeries(opened, row);
  for (std::size_t n = 0; n < opened.study->derived.size(); ++n) addDerivedObject(opened, n);
  if (studies_.isListed(opened)) addRefused(path, *opened.study);
  showDerivedObjects();
  filter(search_->text());
}

void StudiesPanel::showNames() {
  for (const OpenStudy& opened : studies_.all()) showStudy(opened.path);
}

void StudiesPanel::markShown(const Series& shown, const VolumePtr& volume) {
  for (QTreeWidgetItemIterator it(tree_); *it; ++it) {
    const Series* listed = seriesOf(*it);
    const bool is = listed && standsFor(*listed, shown);
    QFont font = (*it)->font(0);
    font.setBold(is);
    (*it)->setFont(0, font);
    if (!is) continue;
    for (const Series* step : stepsOf(*it))
      if (keyOf(*step) == keyOf(shown) && shown.notVolume.empty())
        (*it)->setData(0, stepRole, qulonglong(openedOf(*it)->numberOf(*step)));
    tree_->setCurrentItem(*it);
    if (volume && !opensAsFrames(shown))
      (*it)->setIcon(
          0, untintedIcon(squareThumbnail(thumbnailOf(*volume, shown.unit, thumbnailEdge), thumbnailEdge)));
  }
}

void StudiesPanel::filter(const QString& text) {
  // Works from the leaves up: a parent is visible with any of its children.
  const std::function<bool(QTreeWidgetItem*, bool)> show = [&](QTreeWidgetItem* item, bool all) {
    const bool found = all || item->text(0).contains(text, Qt::CaseInsensitive);
    bool any = found;
    for (int n = 0; n < item->childCount(); ++n) any = show(item->child(n), found) || any;
    item->setHidden(!any);
    return any;
  };
  for (int n = 0; n < tree_->topLevelItemCount(); ++n) show(tree_->topLevelItem(n), text.isEmpty());
}

}  // namespace volumen
