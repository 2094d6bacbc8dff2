#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QTreeView>
#include <algorithm>

#include "results/text/text.h"
#include "ui/panels/saved_searches.h"
#include "ui/panels/series_strip.h"
#include "ui/panels/study_browser.h"
#include "ui/panels/study_columns.h"
#include "ui/widgets/fields.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

// Returns null if the study is not in the list.
const IndexedStudy* studyIn(const StudyList& list, std::int64_t id) {
  for (const ListedPatient& patient : list.patients)
    for (const IndexedStudy& study : patient.studies)
      if (study.id == id) return &study;
  return nullptr;
}

}  // namespace

void StudyBrowser::makeSourceBox() {
  sourceBox_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  connect(sourceBox_, &QComboBox::currentIndexChanged, this,
          [this](int n) { sources_.choose(std::size_t(n)); });
}

void StudyBrowser::showSources() {
  const QSignalBlocker blocker(sourceBox_);
  const std::vector<StudySource*>& offered = sources_.offered();
  QStringList names;
  for (const StudySource* source : offered) names << source->name();
  setItems(sourceBox_, names);
  sourceBox_->setCurrentIndex(int(std::ranges::find(offered, &sources_.current()) - offered.begin()));
  sourceBox_->setVisible(offered.size() > 1);
}

QLayout* StudyBrowser::searchRow() {
  search_->setObjectName(QStringLiteral("browserSearch"));
  search_->setAccessibleName(tr("Search all studies"));
  search_->setClearButtonEnabled(true);
  auto* hide = buttonOf(QStringLiteral("browserHide"), tr("Hide"), [this] { Q_EMIT hideRequested(); });
  hide->setToolTip(tr("Hide the study list (Ctrl+B)"));
  auto* saved = new SavedSearches(search_);
  connect(saved, &SavedSearches::chosen, this, &StudyBrowser::ask);
  return lineOf({sourceBox_, {search_, 1}, saved, import_, hide}, -1);
}

void StudyBrowser::makeTree() {
  tree_->setObjectName(QStringLiteral("browserTree"));
  tree_->setAccessibleName(tr("All patients, studies and series"));
  tree_->setModel(model_);
  tree_->setUniformRowHeights(true);
  tree_->setTextElideMode(Qt::ElideMiddle);  // names of series differ at their ends
  tree_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  tree_->setExpandsOnDoubleClick(false);
  tree_->setDragEnabled(true);
  tree_->setDragDropMode(QAbstractItemView::DragOnly);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  strip_->setContextMenuPolicy(Qt::CustomContextMenu);
  QHeaderView* header = tree_->header();
  header->setStretchLastSection(false);
  header->setSectionResizeMode(int(StudyColumn::description), QHeaderView::Stretch);
  columns_ = new StudyColumns(header);
  header->resizeSection(int(StudyColumn::place),
                        header->fontMetrics().horizontalAdvance(QStringLiteral("This computer")) + 16);
  header->setSectionsClickable(true);
  header->setSortIndicatorShown(true);
  header->setSortIndicator(int(sort_.by), Qt::DescendingOrder);
  connect(header, &QHeaderView::sortIndicatorChanged, this, [this](int column, Qt::SortOrder order) {
    sort_ = {StudyColumn(column), order == Qt::AscendingOrder};
    ask();
  });
  connect(tree_, &QTreeView::activated, this, &StudyBrowser::activate);
  connect(tree_->selectionModel(), &QItemSelectionModel::currentChanged, this, &StudyBrowser::showSeriesOf);
  connect(strip_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    const IndexedSeries* series = strip_->seriesOf(item);
    open(strip_->choiceOf(item), series && series->offline, false);
  });
  for (QWidget* list : {static_cast<QWidget*>(tree_), static_cast<QWidget*>(strip_)})
    connect(list, &QWidget::customContextMenuRequested, this,
            [this, list](QPoint position) { showMenu(list, position); });
}

// Only files of this machine can be sent.
// Only fetched studies can go by themselves.
void StudyBrowser::addKeeping(QMenu* menu, const IndexedChoice& choice) {
  const IndexedStudy* study = studyIn(model_->list(), choice.study);
  const std::optional<bool> isKept = study ? sources_.isKept(study->studyUid) : std::nullopt;
  if (!isKept) return;
  QAction* keep = menu->addAction(tr("Keep on this computer"));
  keep->setCheckable(true);
  keep->setChecked(*isKept);
  connect(keep, &QAction::triggered, this,
          [this, uid = study->studyUid](bool on) { sources_.keep(uid, on); });
}

void StudyBrowser::addSending(QMenu* menu, const IndexedChoice& choice, const IndexedSeries* series) {
  const IndexedStudy* study = studyIn(model_->list(), choice.study);
  if (!study || !sources_.current().filesOf(choice)) return;
  QStringList name{patientNameText(study->patientName), dateText(study->date), shownText(study->description)};
  if (series) name << seriesNameText(*series) << contentText(*series);
  name.removeAll(QString());
  const bool isOffline = series ? series->offline : study->offline;
  menu->addAction(tr("Send to archive..."), this,
                  [this, choice, isOffline, name = name.join(QStringLiteral(", "))] {
                    if (isOffline) return Q_EMIT offlineRequested();
                    Q_EMIT sendRequested(choice, name);
                  });
}

void StudyBrowser::makeRemovedBar() {
  removedBar_->setObjectName(QStringLiteral("removedBar"));
  auto* close = buttonOf(QStringLiteral("removedClose"), tr("Close"), [this] { removedBar_->hide(); });
  auto* row = lineOf({{removedText_, 1}, undo_, close}, -1);
  row->setContentsMargins(0, 0, 0, 0);
  removedBar_->setLayout(row);
  removedBar_->hide();
  connect(undo_, &QPushButton::clicked, this, [this] {
    removedBar_->hide();
    tree_->setFocus();
    sources_.current().undoRemove(std::exchange(removed_, {}));
  });
}

}  // namespace volumen
