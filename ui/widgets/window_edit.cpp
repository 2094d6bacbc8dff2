#include "ui/widgets/window_edit.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <cmath>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int fieldWidth = 62;            // for seven digits
constexpr double largestOfWindow = 1e30;  // as volumes hold it

// The number in a field, with a point or a comma; none: there is none, or it is selected to be typed again.
std::optional<double> numberIn(QLineEdit* field, double least) {
  bool isNumber = false;
  const double number = field->text().trimmed().replace(u',', u'.').toDouble(&isNumber);
  if (isNumber && number >= least && number <= largestOfWindow) return number;
  field->setFocus();
  field->selectAll();
  return {};
}

}  // namespace

WindowEdit::WindowEdit(const Window& window, QWidget* parent)
    : QWidget(parent), width_(new QLineEdit), centre_(new QLineEdit) {
  setAutoFillBackground(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 2, 2, 2);
  row->setSpacing(4);
  for (const auto& [field, letter, name, number] :
       {std::tuple(width_, tr("W"), tr("Width of the window"), window.width),
        std::tuple(centre_, tr("L"), tr("Centre of the window"), window.centre)}) {
    field->setAccessibleName(name);
    field->setToolTip(toolTipOf(name));
    field->setText(QString::number(number, 'g', 6));
    field->setFixedWidth(fieldWidth);
    row->addWidget(plainLabel(letter));
    row->addWidget(field);
  }
  width_->setObjectName(QStringLiteral("flatWindowWidth"));
  centre_->setObjectName(QStringLiteral("flatWindowCentre"));
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
    if (now && isVisible() && !isAncestorOf(now)) leave();
  });
}

void WindowEdit::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return leave();
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return accept();
}

// What is under it is not meant.
void WindowEdit::mousePressEvent(QMouseEvent* event) { event->accept(); }

void WindowEdit::accept() {
  constexpr double narrowest = 1e-9;
  const auto width = numberIn(width_, narrowest);
  if (!width) return;
  const auto centre = numberIn(centre_, -largestOfWindow);
  if (!centre) return;
  Q_EMIT chosen(Window{*centre, *width});
  leave();
}

void WindowEdit::leave() {
  if (isHidden()) return;
  hide();
  deleteLater();
  Q_EMIT closed();
}

}  // namespace volumen
