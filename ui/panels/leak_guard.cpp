#include "ui/panels/leak_guard.h"

#include <QCoreApplication>
#include <algorithm>
#include <string_view>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

QDoubleSpinBox* leakGuardField() {
  const std::vector<StepField>& fields = stepKind("connected")->fields;
  const ValueRange allowed =
      std::ranges::find(fields, std::string_view("leakGuardMm"), &StepField::name)->allowed;
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

}  // namespace volumen
