#include "ui/views/view_window.h"

#include <QCloseEvent>

namespace volumen {

ViewWindow::ViewWindow(const std::function<bool(bool next)>& step) : step_(step) {
  setMinimumSize(200, 200);
  setAttribute(Qt::WA_QuitOnClose, false);
}

void ViewWindow::resizeEvent(QResizeEvent*) { Q_EMIT resized(); }

void ViewWindow::closeEvent(QCloseEvent* event) {
  Q_EMIT closed();
  event->accept();
}

bool ViewWindow::focusNextPrevChild(bool next) { return step_(next) || QWidget::focusNextPrevChild(next); }

}  // namespace volumen
