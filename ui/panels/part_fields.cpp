#include "ui/panels/part_fields.h"

#include <QCoreApplication>
#include <algorithm>
#include <string_view>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

namespace {

const StepField& fieldOfConnected(std::string_view name) {
  return *std::ranges::find(stepKind("connected")->fields, name, &StepField::name);
}

}  // namespace

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
