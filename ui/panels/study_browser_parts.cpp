#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "ui/panels/series_strip.h"
#include "ui/panels/study_browser.h"
#include "ui/panels/study_columns.h"

namespace volumen {

void StudyBrowser::makeSourceBox() {
  sourceBox_->setObjectName(QStringLiteral("browserSource"));
  sourceBox_->setAccessibleName(tr("Where studies are listed from"));
  for (const auto& source : sources_.all()) sourceBox_->addItem(source->name());
  if (sources_.all().size() < 2) sourceBox_->hide();
  connect(sourceBox_, &QComboBox::currentIndexChanged, this,
          [this](int n) { sources_.choose(std::size_t(n)); });
}

void StudyBrowser::makeSearchRow() {
  search_->setObjectName(QStringLiteral("browserSearch"));
  search_->setPlaceholderText(tr("Search by name, ID, date, institution, modality or description"));
  search_->setAccessibleName(tr("Search all studies"));
  search_->setClearButtonEnabled(true);
  import_->setObjectName(QStringLiteral("browserImport"));
  auto* hide = new QToolButton;
  hide->setObjectName(QStringLiteral("browserHide"));
  hide->setText(tr("Hide"));
  hide->setToolTip(tr("Hide the study list (Ctrl+B)"));
  connect(import_, &QPushButton::clicked, this, &StudyBrowser::importRequested);
  connect(hide, &QToolButton::clicked, this, &StudyBrowser::hideRequested);
  auto* row = new QHBoxLayout;
  row->addWidget(sourceBox_);
  row->addWidget(search_, 1);
  row->addWidget(import_);
  row->addWidget(hide);
  static_cast<QVBoxLayout*>(layout())->addLayout(row);
}

void StudyBrowser::makeNotice() {
  notice_->setObjectName(QStringLiteral("browserNotice"));
  notice_->setWordWrap(true);
  notice_->hide();
  layout()->addWidget(notice_);
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

void StudyBrowser::makeRemovedBar() {
  removedBar_->setObjectName(QStringLiteral("removedBar"));
  removedText_->setObjectName(QStringLiteral("removedText"));
  removedText_->setWordWrap(true);
  undo_->setObjectName(QStringLiteral("undoRemove"));
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("removedClose"));
  close->setText(tr("Close"));
  auto* row = new QHBoxLayout(removedBar_);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(removedText_, 1);
  row->addWidget(undo_);
  row->addWidget(close);
  removedBar_->hide();
  connect(close, &QToolButton::clicked, removedBar_, &QWidget::hide);
  connect(undo_, &QPushButton::clicked, this, [this] {
    removedBar_->hide();
    tree_->setFocus();
    sources_.current().undoRemove(std::exchange(removed_, {}));
  });
}

}  // namespace volumen
