#include "ui/widgets/grid_chooser.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolButton>
#include <algorithm>

#include "ui/widgets/plain_text.h"

namespace volumen {

GridChooser::GridChooser(int rows, int columns, QString (*nameOf)(int, int), QWidget* parent)
    : QWidget(parent), columns_(columns), nameOf_(nameOf), said_(plainLabel()) {
  setObjectName(QStringLiteral("gridChooser"));
  setAccessibleName(tr("Grid of series"));
  auto* layout = new QGridLayout(this);
  layout->setSpacing(2);
  for (int n = 0; n < rows * columns; ++n) {
    auto* cell = new QToolButton(this);
    cell->setObjectName(QStringLiteral("grid%1x%2").arg(n / columns + 1).arg(n % columns + 1));
    cell->setAccessibleName(nameOf(n / columns + 1, n % columns + 1));
    cell->setCheckable(true);
    cell->setFocusPolicy(Qt::StrongFocus);
    cell->setMouseTracking(true);
    cell->setFixedSize(22, 18);
    cell->installEventFilter(this);
    connect(cell, &QToolButton::clicked, this, [this, n] { choose(n); });
    layout->addWidget(cell, n / columns, n % columns);
    cells_.push_back(cell);
  }
  said_->setObjectName(QStringLiteral("gridSaid"));
  layout->addWidget(said_, rows, 0, 1, columns, Qt::AlignCenter);
  setFocusPolicy(Qt::StrongFocus);
  setFocusProxy(cells_.front());
  light(0, 0);
}

void GridChooser::light(int rows, int columns) {
  for (int n = 0; n < int(cells_.size()); ++n)
    cells_[std::size_t(n)]->setChecked(n / columns_ < rows && n % columns_ < columns);
  said_->setText(rows > 0 ? nameOf_(rows, columns) : tr("Grid of series"));
}

int GridChooser::numberOf(const QObject* cell) const {
  return int(std::ranges::find(cells_, cell) - cells_.begin());
}

// Returns -1 if there is no cell.
int GridChooser::numberAt(QPoint global) const {
  for (int n = 0; n < int(cells_.size()); ++n) {
    const QToolButton* cell = cells_[std::size_t(n)];
    if (cell->rect().contains(cell->mapFromGlobal(global))) return n;
  }
  return -1;
}

void GridChooser::lightTo(int number) {
  if (number >= 0) light(number / columns_ + 1, number % columns_ + 1);
}

void GridChooser::choose(int number) {
  lightTo(number);
  Q_EMIT chosen(number / columns_ + 1, number % columns_ + 1);
}

// Returns false if the key leaves the grid.
bool GridChooser::step(int number, int key) {
  const int column = number % columns_, last = int(cells_.size()) - 1;
  int next = number;
  if (key == Qt::Key_Left && column > 0) next -= 1;
  if (key == Qt::Key_Right && column + 1 < columns_) next += 1;
  if (key == Qt::Key_Up) next -= columns_;
  if (key == Qt::Key_Down) next += columns_;
  if (next < 0 || next > last) return false;
  cells_[std::size_t(next)]->setFocus(Qt::OtherFocusReason);
  return true;
}

// Handles the mouse for all cells: a button would look pressed and keep the drag to itself.
bool GridChooser::eventFilter(QObject* cell, QEvent* event) {
  const int number = numberOf(cell);
  switch (event->type()) {
    case QEvent::Enter:
    case QEvent::FocusIn:
      lightTo(number);
      return false;
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
      lightTo(numberAt(static_cast<QMouseEvent*>(event)->globalPosition().toPoint()));
      return true;
    case QEvent::MouseButtonRelease:
      if (const int at = numberAt(static_cast<QMouseEvent*>(event)->globalPosition().toPoint()); at >= 0)
        choose(at);
      return true;
    case QEvent::KeyPress: {
      const int key = static_cast<QKeyEvent*>(event)->key();
      if (key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Space) {
        choose(number);
        return true;
      }
      const bool isArrow =
          key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down;
      if (!isArrow) return false;
      if (!step(number, key)) event->ignore();
      return true;
    }
    default:
      return false;
  }
}

}  // namespace volumen
