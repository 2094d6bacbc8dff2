#include "ui/widgets/fold_title.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMouseEvent>
#include <QTimer>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

// Background tabs are moved outside the window and keep their last size.
bool isSeen(const QDockWidget& dock) { return dock.isVisible() && dock.geometry().right() >= 0; }

}  // namespace

FoldTitle::FoldTitle(QDockWidget* dock) : QWidget(dock), dock_(dock), arrow_(new QToolButton) {
  setObjectName(QStringLiteral("foldTitle"));
  setAttribute(Qt::WA_StyledBackground);
  arrow_->setObjectName(dock->objectName() + QStringLiteral("Fold"));
  arrow_->setAutoRaise(true);
  auto* close = new QToolButton;
  close->setAutoRaise(true);
  close->setText(QStringLiteral("\u00d7"));
  close->setToolTip(tr("Close this panel (View > Panels opens it again)"));
  close->setAccessibleName(tr("Close %1").arg(dock->windowTitle()));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2, 1, 2, 1);
  row->setSpacing(2);
  row->addWidget(arrow_);
  row->addWidget(plainLabel(dock->windowTitle()), 1);
  row->addWidget(close);
  connect(arrow_, &QToolButton::clicked, this, [this] { foldWithTabs(!folded_); });
  connect(close, &QToolButton::clicked, dock, &QDockWidget::close);
  dock->setTitleBarWidget(this);
  setFolded(false);
}

void FoldTitle::setFolded(bool folded) {
  folded_ = folded;
  arrow_->setArrowType(folded ? Qt::RightArrow : Qt::DownArrow);
  arrow_->setAccessibleName(folded ? tr("Unfold this panel") : tr("Fold this panel to its title"));
  arrow_->setToolTip(toolTipOf(arrow_->accessibleName()));
  dock_->widget()->setVisible(!folded);
  dock_->setMaximumHeight(folded ? sizeHint().height() : QWIDGETSIZE_MAX);
}

void FoldTitle::foldWithTabs(bool folded) {
  auto* window = qobject_cast<QMainWindow*>(dock_->parentWidget());
  if (!window) return setFolded(folded);
  QList<QDockWidget*> column;
  for (QDockWidget* dock : window->findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly))
    if (isSeen(*dock) && window->dockWidgetArea(dock) == window->dockWidgetArea(dock_)) column << dock;
  if (folded) {
    heightsBefore_.clear();
    for (const QDockWidget* dock : column) heightsBefore_ << dock->height();
  }
  setFolded(folded);
  for (QDockWidget* tab : window->tabifiedDockWidgets(dock_))
    if (auto* title = qobject_cast<FoldTitle*>(tab->titleBarWidget())) title->setFolded(folded);
  // Restores heights after the layout has dropped the maximum height.
  if (!folded && heightsBefore_.size() == column.size())
    QTimer::singleShot(0, dock_,
                       [this, window, column] { window->resizeDocks(column, heightsBefore_, Qt::Vertical); });
}

void FoldTitle::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) setFolded(folded_);
}

// Ignores the event, so that the title still drags the dock; a press without movement is a click.
void FoldTitle::mousePressEvent(QMouseEvent* event) {
  pressedAt_ = event->globalPosition().toPoint();
  event->ignore();
}

void FoldTitle::mouseReleaseEvent(QMouseEvent* event) {
  const QPoint moved = event->globalPosition().toPoint() - pressedAt_;
  const bool click = moved.manhattanLength() < QApplication::startDragDistance();
  event->ignore();
  if (click && event->button() == Qt::LeftButton) foldWithTabs(!folded_);
}

}  // namespace volumen
