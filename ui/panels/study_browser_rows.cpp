// What stays as it is when the list of studies is read again: selection, expanded rows and their place.
#include <QScrollBar>
#include <QTreeView>
#include <algorithm>

#include "ui/panels/study_browser.h"

namespace volumen {

namespace {

constexpr std::size_t shortList = 100;  // most patients whose studies are shown without a click

}  // namespace

StudyBrowser::TreeState StudyBrowser::treeState(bool isSameSearch) const {
  TreeState state;
  state.current = model_->keyOf(tree_->currentIndex());
  for (const QModelIndex& index : tree_->selectionModel()->selectedRows())
    state.selected.insert(model_->keyOf(index));
  if (!isSameSearch) return state;
  state.scrolled = tree_->verticalScrollBar()->value();
  state.anchor = model_->keyOf(anchor());
  state.anchorY = tree_->visualRect(anchor()).y();
  const bool isShort = model_->list().patients.size() <= shortList;
  for (int top = 0; top < model_->rowCount(); ++top) {
    const QModelIndex index = model_->index(top, 0);
    const bool isOpen = tree_->isExpanded(index);
    if (!isOpen && (isShort || model_->isRecentGroup(index))) state.collapsed.insert(model_->keyOf(index));
    if (!isOpen) continue;
    state.expanded.insert(model_->keyOf(index));
    for (int n = 0; n < model_->rowCount(index); ++n)
      if (tree_->isExpanded(model_->index(n, 0, index)))
        state.expanded.insert(model_->keyOf(model_->index(n, 0, index)));
  }
  return state;
}

void StudyBrowser::restore(const TreeState& state) {
  const bool isShort = model_->list().patients.size() <= shortList;
  for (int top = 0; top < (isShort ? model_->rowCount() : 1); ++top) {
    const QModelIndex index = model_->index(top, 0);
    if ((isShort || model_->isRecentGroup(index)) && !state.collapsed.contains(model_->keyOf(index)))
      tree_->setExpanded(index, true);
  }
  for (const StudyRowKey& key : state.expanded) tree_->setExpanded(model_->indexOf(key), true);
  QItemSelectionModel* selection = tree_->selectionModel();
  QModelIndex current = model_->indexOf(state.current);
  if (!current.isValid()) {
    current = model_->firstPatient();
    proposed_ = model_->keyOf(current);
  }
  tree_->setAutoScroll(false);  // keeps the scroll position
  selection->setCurrentIndex(current, QItemSelectionModel::NoUpdate);
  tree_->setAutoScroll(true);
  const auto select = [&](const QModelIndex& index) {
    if (index.isValid()) selection->select(index, QItemSelectionModel::Select | QItemSelectionModel::Rows);
  };
  for (const StudyRowKey& key : state.selected) select(model_->indexOf(key));
  if (!selection->hasSelection()) select(current);
  tree_->visualRect(current);  // lays out the rows, so that scrolling works
  scrollBack(state);
}

// Returns the row whose place is kept while others come: the one that the user went to, or the uppermost of a
// list that was scrolled.
QModelIndex StudyBrowser::anchor() const {
  if (!model_->list().isGrowing) return {};
  const QModelIndex current = tree_->currentIndex();
  const bool isVisible = tree_->viewport()->rect().contains(tree_->visualRect(current).center());
  if (isVisible && model_->keyOf(current) != proposed_) return current;
  return tree_->verticalScrollBar()->value() > 0 ? tree_->indexAt(QPoint(0, 0)) : QModelIndex();
}

void StudyBrowser::scrollBack(const TreeState& state) {
  QScrollBar* bar = tree_->verticalScrollBar();
  bar->setValue(state.scrolled);
  const QModelIndex anchor = model_->indexOf(state.anchor);
  if (!anchor.isValid()) return;
  const QRect now = tree_->visualRect(anchor);
  const bool isByRow = tree_->verticalScrollMode() == QAbstractItemView::ScrollPerItem;
  bar->setValue(state.scrolled + (now.y() - state.anchorY) / (isByRow ? std::max(1, now.height()) : 1));
}

}  // namespace volumen
