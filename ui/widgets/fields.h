#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <functional>
#include <vector>

class QBoxLayout;

namespace volumen {

/// Range and format of a number.
struct NumberFormat {
  double low = 0, high = 1;
  int decimals = 2;
  QString suffix = {};       ///< " mm"
  bool logarithmic = false;  ///< the scale of a slider; requires low > 0
  QString prefix = {};
  QString atLow = {};   ///< shown in place of `low`
  bool isLive = false;  ///< a field reports each typed digit
};

/// Object name, label and tool tip of a field.
struct FieldText {
  QString name, label, tip = {};
};

QDoubleSpinBox* numberField(const FieldText& text, const NumberFormat& format);
QSpinBox* wholeField(const FieldText& text, int low, int high, const QString& suffix = {});
QCheckBox* flagField(const FieldText& text);
/// With `leastLetters`, the list may be narrower than its entries, so that long names widen no panel.
QComboBox* choiceField(const FieldText& text, const QStringList& items = {}, int leastLetters = 0);
/// Makes these the entries of a list. The same entries stay as they are.
void setItems(QComboBox* box, const QStringList& items);
/// Returns a label that shows every character as it is and wraps.
QLabel* wrappedLabel(const QString& name, const QString& text = {});

/// Makes a button that calls `clicked`.
template <class Button = QToolButton>
Button* buttonOf(const QString& name, const QString& text = {}, const std::function<void()>& clicked = {}) {
  auto* button = new Button;
  button->setObjectName(name);
  button->setText(text);
  if (clicked) QObject::connect(button, &Button::clicked, button, clicked);
  return button;
}

/// Adds Cancel and a default button that accepts the dialog. Returns the latter.
QPushButton* addAccept(QDialog& dialog, QDialogButtonBox& buttons, const QString& name, const QString& text);

/// Adds a button that calls `clicked`. It is never the default one, so that Enter ends editing of a cell.
QPushButton* addButton(QDialogButtonBox& buttons, const QString& name, const QString& text,
                       const std::function<void()>& clicked);

/// A part of a line or a column: a widget, a layout, a text, or by default an elastic gap.
struct LayoutPart {
  LayoutPart() = default;
  LayoutPart(QWidget* aWidget, int aStretch = 0) : widget(aWidget), stretch(aStretch) {}
  LayoutPart(QLayout* aLayout) : layout(aLayout) {}
  LayoutPart(const QString& text);

  QWidget* widget = nullptr;
  QLayout* layout = nullptr;
  int stretch = 0;
};

/// Returns a line of parts.
QBoxLayout* lineOf(const std::vector<LayoutPart>& parts, int spacing = 4);
/// Lays out parts in a widget, one below another. Returns the layout.
QBoxLayout* stack(QWidget* owner, const std::vector<LayoutPart>& parts, int margin = 0, int spacing = 4);
/// Returns a label for a field.
QLabel* captionOf(const QString& text, QWidget* field);
/// Lays out fields in a widget below each other, each with its accessible name before it.
void stackWithCaptions(QWidget* owner, const std::vector<QWidget*>& fields);

}  // namespace volumen
