#include "ui/widgets/fields.h"

#include <QGridLayout>
#include <QVBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int leastNumberWidth = 64;  // pixels; the default would leave room for huge numbers

template <class Field>
Field* withText(Field* field, const FieldText& text) {
  field->setObjectName(text.name);
  field->setAccessibleName(text.label);
  field->setToolTip(toolTipOf(text.tip));
  return field;
}

QBoxLayout* filled(QBoxLayout* box, const std::vector<LayoutPart>& parts, int spacing) {
  box->setSpacing(spacing);
  for (const LayoutPart& part : parts) {
    if (part.widget)
      box->addWidget(part.widget, part.stretch);
    else if (part.layout)
      box->addLayout(part.layout);
    else
      box->addStretch();
  }
  return box;
}

}  // namespace

QDoubleSpinBox* numberField(const FieldText& text, const NumberFormat& format) {
  auto* field = withText(new QDoubleSpinBox, text);
  field->setDecimals(format.decimals);
  field->setRange(format.low, format.high);
  field->setPrefix(format.prefix);
  field->setSuffix(format.suffix);
  field->setSpecialValueText(format.atLow);
  field->setKeyboardTracking(format.isLive);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(leastNumberWidth);
  return field;
}

QSpinBox* wholeField(const FieldText& text, int low, int high, const QString& suffix) {
  auto* field = withText(new QSpinBox, text);
  field->setRange(low, high);
  field->setSuffix(suffix);
  return field;
}

QCheckBox* flagField(const FieldText& text) { return withText(new QCheckBox(text.label), text); }

QComboBox* choiceField(const FieldText& text, const QStringList& items, int leastLetters) {
  auto* box = withText(new QComboBox, text);
  box->addItems(items);
  if (leastLetters == 0) return box;
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(leastLetters);
  return box;
}

void setItems(QComboBox* box, const QStringList& items) {
  QStringList now;
  for (int n = 0; n < box->count(); ++n) now << box->itemText(n);
  if (now == items) return;
  box->clear();
  box->addItems(items);
}

QLabel* wrappedLabel(const QString& name, const QString& text) {
  QLabel* label = plainLabel(text);
  label->setObjectName(name);
  label->setWordWrap(true);
  return label;
}

QPushButton* addAccept(QDialog& dialog, QDialogButtonBox& buttons, const QString& name, const QString& text) {
  buttons.addButton(QDialogButtonBox::Cancel);
  QPushButton* accept = buttons.addButton(text, QDialogButtonBox::AcceptRole);
  accept->setObjectName(name);
  accept->setDefault(true);
  QObject::connect(&buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  QObject::connect(&buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  return accept;
}

QPushButton* addButton(QDialogButtonBox& buttons, const QString& name, const QString& text,
                       const std::function<void()>& clicked) {
  auto* button = buttonOf<QPushButton>(name, text, clicked);
  button->setAutoDefault(false);
  buttons.addButton(button, QDialogButtonBox::ActionRole);
  return button;
}

LayoutPart::LayoutPart(const QString& text) : widget(plainLabel(text)) {}

QBoxLayout* lineOf(const std::vector<LayoutPart>& parts, int spacing) {
  return filled(new QHBoxLayout, parts, spacing);
}

QBoxLayout* stack(QWidget* owner, const std::vector<LayoutPart>& parts, int margin, int spacing) {
  auto* column = new QVBoxLayout(owner);
  column->setContentsMargins(margin, margin, margin, margin);
  return filled(column, parts, spacing);
}

QLabel* captionOf(const QString& text, QWidget* field) {
  QLabel* caption = plainLabel(text);
  caption->setBuddy(field);
  return caption;
}

void stackWithCaptions(QWidget* owner, const std::vector<QWidget*>& fields) {
  auto* grid = new QGridLayout(owner);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(1, 1);
  for (int row = 0; row < int(fields.size()); ++row) {
    QWidget* field = fields[std::size_t(row)];
    grid->addWidget(captionOf(field->accessibleName(), field), row, 0);
    grid->addWidget(field, row, 1);
  }
}

}  // namespace volumen
