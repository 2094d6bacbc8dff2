#include "ui/panels/material_panel.h"

#include <QVBoxLayout>

#include "ui/panels/bindings_to.h"

namespace volumen {

MaterialPanel::MaterialPanel(Session& session, QWidget* parent)
    : QWidget(parent), bindings_(bindingsTo(session)) {
  auto* lit = new QCheckBox(tr("Lighting"));
  lit->setObjectName(QStringLiteral("lit"));
  lit->setToolTip(tr("Without it, only colour and opacity are drawn."));
  auto* sides = new QComboBox;
  sides->setObjectName(QStringLiteral("sides"));
  sides->setAccessibleName(tr("Lit sides of a surface"));
  sides->addItems({tr("Two-sided lighting"), tr("One-sided lighting")});
  const auto row = [](const QString& name, const NumberFormat& format) {
    return new NumberRow(name, format);
  };
  auto* rows = new QWidget;
  auto* ambient = row(tr("Ambient"), {.low = 0, .high = 1, .decimals = 2});
  auto* diffuse = row(tr("Diffuse"), {.low = 0, .high = 2, .decimals = 2});
  auto* specular = row(tr("Specular"), {.low = 0, .high = 2, .decimals = 2});
  auto* shininess = row(tr("Shininess"), {.low = 1, .high = 10000, .decimals = 0, .logarithmic = true});
  auto* inner = new QVBoxLayout(rows);
  inner->setContentsMargins(0, 0, 0, 0);
  inner->setSpacing(4);
  for (NumberRow* each : {ambient, diffuse, specular, shininess}) inner->addWidget(each);
  inner->addWidget(sides);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(lit);
  column->addWidget(rows);
  column->addStretch();

  bindings_.flag(lit, tr("Lighting"), [](Scene& s) -> bool& { return s.shading.lit; });
  bindings_.number(ambient, tr("Ambient"), [](Scene& s) -> double& { return s.shading.ambient; });
  bindings_.number(diffuse, tr("Diffuse"), [](Scene& s) -> double& { return s.shading.diffuse; });
  bindings_.number(specular, tr("Specular"), [](Scene& s) -> double& { return s.shading.specular; });
  bindings_.number(shininess, tr("Shininess"), [](Scene& s) -> double& { return s.shading.shininess; });
  bindings_.choice<int>(sides, tr("Lit sides"), [](Scene& s) -> int& { return s.shading.sides; }, {2, 1});
  const auto show = [this, rows](const Scene& scene) {
    bindings_.show(scene);
    rows->setEnabled(scene.shading.lit);
  };
  connect(&session, &Session::changed, this, [show](const SessionState& before, const SessionState& after) {
    if (!(before.scene.shading == after.scene.shading)) show(after.scene);
  });
  show(session.scene());
}

}  // namespace volumen
