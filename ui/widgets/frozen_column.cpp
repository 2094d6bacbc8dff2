#include "ui/widgets/frozen_column.h"

#include <QEvent>
#include <QHeaderView>
#include <QScrollBar>

namespace volumen {

FrozenColumn::FrozenColumn(QTableView* table) : QTableView(table), table_(table) {
  setModel(table->model());
  setSelectionModel(table->selectionModel());
  setSelectionBehavior(table->selectionBehavior());
  setEditTriggers(table->editTriggers());
  setAlternatingRowColors(table->alternatingRowColors());
  setContextMenuPolicy(table->contextMenuPolicy());
  addActions(table->actions());
  setFocusProxy(table);
  setFrameShape(QFrame::NoFrame);
  verticalHeader()->hide();
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scrollWithTable();
  sortWithTable();
  const auto placed = [this] { place(); };
  connect(table->horizontalHeader(), &QHeaderView::sectionCountChanged, this, placed);
  connect(table->horizontalHeader(), &QHeaderView::sectionResized, this, placed);
  connect(horizontalHeader(), &QHeaderView::sectionResized, this, [this](int column, int, int width) {
    if (column == 0 && width > 0) table_->setColumnWidth(0, width);
  });
  connect(selectionModel(), &QItemSelectionModel::currentChanged, this, &FrozenColumn::uncover);
  for (QWidget* part : {table->viewport(), static_cast<QWidget*>(table->horizontalHeader())})
    part->installEventFilter(this);
  place();
}

void FrozenColumn::scrollWithTable() {
  for (QTableView* view : {table_, static_cast<QTableView*>(this)}) {
    view->setVerticalScrollMode(ScrollPerPixel);
    view->setHorizontalScrollMode(ScrollPerPixel);
  }
  connect(table_->verticalScrollBar(), &QScrollBar::valueChanged, verticalScrollBar(), &QScrollBar::setValue);
  connect(verticalScrollBar(), &QScrollBar::valueChanged, table_->verticalScrollBar(), &QScrollBar::setValue);
}

void FrozenColumn::sortWithTable() {
  QHeaderView *all = table_->horizontalHeader(), *first = horizontalHeader();
  first->setSectionsClickable(true);
  first->setSortIndicatorShown(true);
  first->setSortIndicator(all->sortIndicatorSection(), all->sortIndicatorOrder());
  connect(first, &QHeaderView::sortIndicatorChanged, all, &QHeaderView::setSortIndicator);
  connect(all, &QHeaderView::sortIndicatorChanged, first, &QHeaderView::setSortIndicator);
}

bool FrozenColumn::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Move) place();
  return QTableView::eventFilter(watched, event);
}

void FrozenColumn::place() {
  for (int column = 0; column < model()->columnCount(); ++column) setColumnHidden(column, column > 0);
  setColumnWidth(0, table_->columnWidth(0));
  const QWidget* rows = table_->viewport();
  const QRect head = table_->horizontalHeader()->geometry();
  horizontalHeader()->setFixedHeight(head.height());
  setGeometry(rows->x(), head.y(), table_->columnWidth(0), head.height() + rows->height());
}

// The table scrolls only to its own left edge, which this column covers.
void FrozenColumn::uncover(const QModelIndex& current) {
  const int left = table_->visualRect(current).left();
  if (current.column() > 0 && left < width())
    table_->horizontalScrollBar()->setValue(table_->horizontalScrollBar()->value() + left - width());
}

}  // namespace volumen
