#include "ui/widgets/command_list.h"
#include "ui/widgets/plain_text.h"

#include <QBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QTreeWidget>
#include <algorithm>
#include <utility>

namespace volumen {

namespace {

constexpr QSize largestList(720, 420);  // logical pixels
constexpr int besideList = 40;          // window margin around the list

bool isOwnKey(int key) {
  return key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_Return || key == Qt::Key_Enter ||
         key == Qt::Key_Escape;
}

QTreeWidget* makeRowsView() {
  auto* list = new QTreeWidget;
  list->setObjectName(QStringLiteral("commandRows"));
  list->setAccessibleName(CommandList::tr("Commands"));
  list->setColumnCount(3);
  list->setHeaderHidden(true);
  list->setRootIsDecorated(false);
  list->setUniformRowHeights(true);
  list->setFocusPolicy(Qt::NoFocus);
  list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list->header()->setStretchLastSection(false);
  list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (const int column : {1, 2}) list->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  return list;
}

}  // namespace

CommandList::CommandList(QWidget* window) : QFrame(window), search_(new QLineEdit), list_(makeRowsView()) {
  setObjectName(QStringLiteral("commandList"));
  setAccessibleName(tr("Commands"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  search_->setObjectName(QStringLiteral("commandSearch"));
  search_->setAccessibleName(tr("Search commands"));
  search_->setPlaceholderText(tr("Type what you want to do"));
  search_->setClearButtonEnabled(true);
  search_->installEventFilter(this);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(search_);
  column->addWidget(list_);
  connect(search_, &QLineEdit::textChanged, this, &CommandList::typed);
  connect(list_, &QTreeWidget::itemClicked, this,
          [this](QTreeWidgetItem* item) { choose(list_->indexOfTopLevelItem(item)); });
  hide();
}

void CommandList::openIn(QWidget* other) {
  if (parentWidget() != other) {
    if (isVisible()) leave();
    setParent(other);
  }
  if (!isVisible()) before_ = window()->focusWidget();
  const QSize room = parentWidget()->size() - QSize(2 * besideList, 2 * besideList);
  resize(largestList.boundedTo(room));
  move((parentWidget()->width() - width()) / 2, besideList);
  const QSignalBlocker quiet(search_);
  search_->clear();
  Q_EMIT typed({});
  show();
  raise();
  search_->setFocus();
}

void CommandList::setRows(const std::vector<Row>& rows) {
  list_->clear();
  for (const Row& row : rows) {
    auto* item = new QTreeWidgetItem({row.text, row.path, row.keys});
    item->setTextAlignment(2, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(0, toolTipOf(row.text));
    if (!row.canBeChosen) item->setFlags(Qt::NoItemFlags);
    list_->addTopLevelItem(item);
  }
  go(1);
}

bool CommandList::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (!isOwnKey(key)) return QFrame::eventFilter(watched, event);
    event->accept();
    return event->type() == QEvent::ShortcutOverride || pressKey(key);
  }
  const bool isLeft = event->type() == QEvent::FocusOut && isVisible();
  if (isLeft) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::ActiveWindowFocusReason && reason != Qt::PopupFocusReason) hide();
  }
  return QFrame::eventFilter(watched, event);
}

bool CommandList::pressKey(int key) {
  if (key == Qt::Key_Escape)
    leave();
  else if (key == Qt::Key_Up || key == Qt::Key_Down)
    go(key == Qt::Key_Down ? 1 : -1);
  else if (list_->currentItem())
    choose(list_->indexOfTopLevelItem(list_->currentItem()));
  return true;
}

// Selects the next enabled row; stops at the ends.
void CommandList::go(int step) {
  int row = list_->currentItem() ? list_->indexOfTopLevelItem(list_->currentItem()) : -1;
  do row += step;
  while (row >= 0 && row < list_->topLevelItemCount() &&
         !(list_->topLevelItem(row)->flags() & Qt::ItemIsEnabled));
  if (row >= 0 && row < list_->topLevelItemCount()) list_->setCurrentItem(list_->topLevelItem(row));
}

void CommandList::choose(int row) {
  if (!(list_->topLevelItem(row)->flags() & Qt::ItemIsEnabled)) return;
  leave();
  Q_EMIT chosen(row);
}

// Restores focus first: a hidden field would pass it to the next widget.
void CommandList::leave() {
  if (before_) before_->setFocus();
  hide();
}

}  // namespace volumen
