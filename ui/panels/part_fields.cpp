#include "ui/panels/part_fields.h"

#include <QCoreApplication>
#include <algorithm>
#include <string_view>

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

namespace {

const StepField& fieldOfConnected(std::string_view name) {
  return *std::ranges::find(stepKind("connected")->fields, name, &StepField::name);
}

constexpr const char* actionProperty = "action";

}  // namespace

void bindOption(QCheckBox* box, SegmentEditing& editing, bool SegmentOptions::*option) {
  QObject::connect(box, &QCheckBox::toggled, box, [&editing, option](bool on) {
    editing.choose([&](SegmentOptions& options) { options.*option = on; });
  });
  const auto show = [box, &editing, option] { box->setChecked(editing.options().*option); };
  QObject::connect(&editing, &SegmentEditing::optionsChanged, box, show);
  show();
}

// A value being typed keeps its text.
void bindOption(QDoubleSpinBox* field, SegmentEditing& editing, double SegmentOptions::*option) {
  QObject::connect(field, &QDoubleSpinBox::valueChanged, field, [&editing, option](double value) {
    editing.choose([&](SegmentOptions& options) { options.*option = value; });
  });
  const auto show = [field, &editing, option] {
    if (field->value() != editing.options().*option) field->setValue(editing.options().*option);
  };
  QObject::connect(&editing, &SegmentEditing::optionsChanged, field, show);
  show();
}

QToolButton* toolButton(const char* name, const char* action) {
  auto* button = new QToolButton;
  button->setObjectName(QLatin1String(name));
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setProperty(actionProperty, QLatin1String(action));
  return button;
}

QString actionOf(const QToolButton* button) { return button->property(actionProperty).toString(); }

QComboBox* narrowChoice(const char* name, const QString& label) {
  auto* choice = new QComboBox;
  choice->setObjectName(QLatin1String(name));
  choice->setAccessibleName(label);
  choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  choice->setMinimumContentsLength(6);
  return choice;
}

QDoubleSpinBox* leakGuardField() {
  const ValueRange allowed = fieldOfConnected("leakGuardMm").allowed;
  auto* field = new QDoubleSpinBox;
  field->setObjectName(QStringLiteral("segmentLeakGuard"));
  field->setAccessibleName(tr("Leak guard of connected parts"));
  field->setToolTip(
      toolTipOf(tr("Connected parts go through nothing that is thinner than twice this, such as a bridge "
                   "between bone and table, and lose what is as thin themselves. 0: off.")));
  field->setRange(allowed.low, allowed.high);
  field->setDecimals(1);
  field->setSingleStep(0.5);
  field->setSuffix(tr(" mm"));
  field->setSpecialValueText(tr("Off"));
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(70);
  return field;
}

QComboBox* partNeighboursField() {
  auto* field = new QComboBox;
  field->setObjectName(QStringLiteral("segmentPartNeighbours"));
  field->setAccessibleName(tr("Which voxels touch in connected parts"));
  field->setToolTip(
      toolTipOf(tr("Which voxels of a connected part touch: those that share a face (6 "
                   "neighbours), an edge too (18), a corner too (26).")));
  for (const char* word : fieldOfConnected("neighbours").words) field->addItem(QLatin1String(word));
  return field;
}

}  // namespace volumen
