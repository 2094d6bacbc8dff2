#include "ui/views/window_beside.h"

#include <QCloseEvent>

namespace volumen {

WindowBeside::WindowBeside(const std::function<bool(bool next)>& step) : step_(step) {
  setMinimumSize(200, 200);
  setAttribute(Qt::WA_QuitOnClose, false);
}

void WindowBeside::resizeEvent(QResizeEvent*) { Q_EMIT resized(); }

void WindowBeside::closeEvent(QCloseEvent* event) {
  Q_EMIT closed();
  event->accept();
}

bool WindowBeside::focusNextPrevChild(bool next) { return step_(next) || QWidget::focusNextPrevChild(next); }

}  // namespace volumen
