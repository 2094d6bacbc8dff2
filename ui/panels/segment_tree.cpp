#include "ui/panels/segment_tree.h"

#include <QMouseEvent>
#include <QStyle>
#include <utility>

namespace volumen {

// Returns the row whose check box is under the pointer, or an invalid index.
QModelIndex SegmentTree::boxAt(const QMouseEvent& event) const {
  const QModelIndex index = indexAt(event.position().toPoint());
  if (event.button() != Qt::LeftButton || !index.isValid() || index.column() != 0) return {};
  QStyleOptionViewItem option;
  initViewItemOption(&option);
  option.rect = visualRect(index);
  option.features |= QStyleOptionViewItem::HasCheckIndicator | QStyleOptionViewItem::HasDecoration;
  const QRect box = style()->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, this);
  return box.contains(event.position().toPoint()) ? index : QModelIndex();
}

void SegmentTree::mousePressEvent(QMouseEvent* event) {
  pressed_ = boxAt(*event);
  if (!pressed_.isValid()) QTreeWidget::mousePressEvent(event);
}

void SegmentTree::mouseDoubleClickEvent(QMouseEvent* event) {
  pressed_ = boxAt(*event);
  if (!pressed_.isValid()) QTreeWidget::mouseDoubleClickEvent(event);
}

void SegmentTree::mouseMoveEvent(QMouseEvent* event) {
  if (!pressed_.isValid()) QTreeWidget::mouseMoveEvent(event);
}

void SegmentTree::mouseReleaseEvent(QMouseEvent* event) {
  const QModelIndex pressed = std::exchange(pressed_, QPersistentModelIndex());
  if (!pressed.isValid()) return QTreeWidget::mouseReleaseEvent(event);
  if (boxAt(*event) != pressed) return;
  QTreeWidgetItem* item = itemFromIndex(pressed);
  item->setCheckState(0, item->checkState(0) == Qt::Checked ? Qt::Unchecked : Qt::Checked);
}

}  // namespace volumen
