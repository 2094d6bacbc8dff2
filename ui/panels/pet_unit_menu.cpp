#include "ui/panels/pet_unit_menu.h"

#include <QActionGroup>

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

QString textOf(PetUnit unit) {
  switch (unit) {
    case PetUnit::suvBodyWeight:
      return tr("SUVbw (body weight)");
    case PetUnit::suvLeanBodyMass:
      return tr("SUVlbm (lean body mass)");
    case PetUnit::suvBodySurface:
      return tr("SUVbsa (body surface area)");
    case PetUnit::file:
      return tr("As in the file (Bq/ml)");
  }
  return {};
}

}  // namespace

QMenu* makePetUnitMenu(Session& session, QWidget* parent) {
  auto* menu = new QMenu(tr("PET values"), parent);
  menu->setObjectName(QStringLiteral("petUnitMenu"));
  menu->setToolTipsVisible(true);
  auto* group = new QActionGroup(menu);
  for (const PetUnit unit :
       {PetUnit::suvBodyWeight, PetUnit::suvLeanBodyMass, PetUnit::suvBodySurface, PetUnit::file}) {
    QAction* action = menu->addAction(textOf(unit));
    action->setObjectName(QStringLiteral("petUnit") + QLatin1String(petUnitName(unit)));
    action->setCheckable(true);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, menu,
                     [&session, unit] { session.prefer([unit](Preferences& p) { p.petUnit = unit; }); });
    QObject::connect(menu, &QMenu::aboutToShow, action, [&session, action, unit] {
      const Series* series = seriesIn(session.workspace(), session.workspace().focus);
      action->setChecked(session.preferences().petUnit == unit);
      action->setToolTip(toolTipOf(series ? shownText(valueScale(*series, unit).why) : QString()));
    });
  }
  return menu;
}

}  // namespace volumen
