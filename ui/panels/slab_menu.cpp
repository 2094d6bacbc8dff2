#include "ui/panels/slab_menu.h"

#include <QActionGroup>
#include <QWidgetAction>

#include "results/text/text.h"
#include "ui/panels/flat_menus.h"
#include "ui/tools/tool.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

constexpr double firstSlabMm = 10, thickestMm = 500;

void addThickness(QMenu* menu, Session& session, ViewId view) {
  auto* field = thicknessField(QStringLiteral("slabThickness"));
  field->setValue(flatLookOf(session.workspace().view(view)).slabMm);
  QObject::connect(field, &QDoubleSpinBox::valueChanged, menu, [&session, view](double mm) {
    editFlat(session, view, tr("Slab"), [mm](FlatLook& look) { look.slabMm = mm; });
  });
  QObject::connect(field, &QDoubleSpinBox::editingFinished, menu, [&session] { session.endGesture(); });
  auto* row = new QWidget;
  auto* line = lineOf({tr("Thickness"), {field, 1}}, -1);
  line->setContentsMargins(12, 4, 12, 4);
  row->setLayout(line);
  auto* action = new QWidgetAction(menu);
  action->setDefaultWidget(row);
  menu->addAction(action);
}

void addModes(QMenu* menu, Session& session, ViewId view) {
  auto* group = new QActionGroup(menu);
  const FlatLook look = flatLookOf(session.workspace().view(view));
  for (const SlabModeRow& row : slabModes()) {
    QAction* action = menu->addAction(row.text);
    action->setObjectName(QLatin1String(row.name));
    action->setCheckable(true);
    action->setChecked(look.slabMm > 0 && look.slabMode == row.mode);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, menu, [&session, view, mode = row.mode] {
      session.endGesture();
      editFlat(session, view, tr("Slab"), [mode](FlatLook& changed) { setSlabMode(changed, mode); });
      session.endGesture();
    });
  }
}

void fillSlabMenu(QMenu* menu, Session& session) {
  menu->clear();
  const Workspace& workspace = session.workspace();
  const ViewId view = flatViewInFocus(workspace);
  if (workspace.view(view).series.empty() || !showsSlices(workspace.view(view).kind)) {
    menu->addAction(tr("A slab is made of planes through a volume."))->setEnabled(false);
    return;
  }
  addThickness(menu, session, view);
  menu->addSeparator();
  addModes(menu, session, view);
}

}  // namespace

std::vector<SlabModeRow> slabModes() {
  return {{SlabMode::max, "slabMax", tr("Maximum (MIP)")},
          {SlabMode::min, "slabMin", tr("Minimum (MinIP)")},
          {SlabMode::mean, "slabMean", tr("Mean")}};
}

void setSlabMode(FlatLook& look, SlabMode mode) {
  look.slabMode = mode;
  if (look.slabMm == 0) look.slabMm = firstSlabMm;
}

QDoubleSpinBox* thicknessField(const QString& name) {
  auto* field = numberField({name, tr("Thickness of the slab")},
                            {.low = 0, .high = thickestMm, .decimals = 1, .suffix = tr(" mm")});
  field->setButtonSymbols(QAbstractSpinBox::UpDownArrows);
  return field;
}

QString interpolationText(ViewKind kind) {
  return showsFrames(kind) ? tr("Interpolate between pixels") : tr("Interpolate between voxels");
}

QMenu* makeSlabMenu(Session& session, QWidget* parent) {
  auto* menu = new QMenu(tr("Slab"), parent);
  menu->setObjectName(QStringLiteral("slabMenu"));
  QObject::connect(menu, &QMenu::aboutToShow, menu, [menu, &session] { fillSlabMenu(menu, session); });
  return menu;
}

QAction* makeInterpolationAction(Session& session, QObject* parent) {
  auto* action = new QAction(parent);
  action->setObjectName(QStringLiteral("interpolate"));
  action->setCheckable(true);
  const auto show = [action, &session] {
    const ViewState& view = session.workspace().view(flatViewInFocus(session.workspace()));
    action->setText(interpolationText(view.kind));
    action->setEnabled(!view.series.empty() && isFlat(view.kind));
    action->setChecked(!flatLookOf(view).nearest);
  };
  whenChanged(session, action, show, showsOther);
  QObject::connect(action, &QAction::triggered, action, [&session](bool on) {
    const ViewId view = flatViewInFocus(session.workspace());
    session.endGesture();
    session.change(tr("Interpolation"),
                   withFlatLooks(session.workspace(), view, [on](FlatLook& look) { look.nearest = !on; }));
  });
  show();
  return action;
}

}  // namespace volumen
