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
constexpr double largestOfWindow = 1e30;  // limit of volumes

// Returns the number in a field, with a point or a comma. If it is invalid, selects the field and returns
// nothing.
std::optional<double> numberIn(QLineEdit* field, double least) {
  bool isNumber = false;
  const double number = field->text().trimmed().replace(u',', u'.').toDouble(&isNumber);
  if (isNumber && number >= least && number <= largestOfWindow) return number;
  field->setFocus();
  field->selectAll();
  return {};
}

}  // namespace

WindowEdit::WindowEdit(const Window& window, QWidget* parent, Fields fields)
    : QWidget(parent), fields_(fields), first_(new QLineEdit), second_(new QLineEdit) {
  setAutoFillBackground(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 2, 2, 2);
  row->setSpacing(4);
  const auto add = [&](QLineEdit* field, const QString& letter, const QString& name, const char* objectName,
                       double number) {
    field->setAccessibleName(name);
    field->setToolTip(toolTipOf(name));
    field->setText(QString::number(number, 'g', 6));
    field->setFixedWidth(fieldWidth);
    field->setObjectName(QLatin1String(objectName));
    row->addWidget(plainLabel(letter));
    row->addWidget(field);
  };
  if (fields == Fields::ends) {
    const double low = window.centre - window.width / 2;
    const bool isZero = std::abs(low) < 1e-9 * window.width;  // except for rounding
    add(first_, tr("from"), tr("Lowest value"), "barLow", isZero ? 0 : low);
    add(second_, tr("to"), tr("Highest value"), "barHigh", window.centre + window.width / 2);
  } else {
    add(first_, tr("W"), tr("Width of the window"), "flatWindowWidth", window.width);
    add(second_, tr("L"), tr("Centre of the window"), "flatWindowCentre", window.centre);
  }
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
    if (now && isVisible() && !isAncestorOf(now)) leave();
  });
}

// Claims Esc before other shortcuts.
bool WindowEdit::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void WindowEdit::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return leave();
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return accept();
}

// Keeps clicks from the widgets below.
void WindowEdit::mousePressEvent(QMouseEvent* event) { event->accept(); }

// Returns nothing if a field is invalid, and selects that field.
std::optional<Window> WindowEdit::typed() const {
  constexpr double narrowest = 1e-9;
  const bool ends = fields_ == Fields::ends;
  const auto first = numberIn(first_, ends ? -largestOfWindow : narrowest);
  if (!first) return {};
  const auto second = numberIn(second_, ends ? std::nextafter(*first, largestOfWindow) : -largestOfWindow);
  if (!second) return {};
  return ends ? Window{(*first + *second) / 2, *second - *first} : Window{*second, *first};
}

void WindowEdit::accept() {
  const std::optional<Window> window = typed();
  if (!window) return;
  Q_EMIT chosen(*window);
  leave();
}

void WindowEdit::leave() {
  if (isHidden()) return;
  hide();
  deleteLater();
  Q_EMIT closed();
}

}  // namespace volumen
