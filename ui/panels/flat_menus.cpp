#include "ui/panels/flat_menus.h"

#include <QActionGroup>
#include <QSlider>
#include <QWidgetAction>
#include <cmath>

#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/workspace/link_text.h"

namespace volumen {

namespace {

void addColours(QMenu* menu, const char* prefix, ColourMap now,
                const std::function<void(ColourMap)>& choose) {
  auto* group = new QActionGroup(menu);
  for (const ColourMap map : colourMaps()) {
    QAction* action = menu->addAction(colourMapText(map));
    action->setObjectName(QLatin1String(prefix) + QLatin1String(colourMapName(map)));
    action->setCheckable(true);
    action->setChecked(map == now);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, menu, [choose, map] { choose(map); });
  }
}

void addOpacity(QMenu* menu, Session& session, ViewId view, double now) {
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("overlayOpacity"));
  slider->setAccessibleName(tr("Opacity of the overlay"));
  slider->setRange(0, 100);
  slider->setValue(int(std::lround(100 * now)));
  slider->setToolTip(tr("Opacity of the overlay"));
  QObject::connect(slider, &QSlider::valueChanged, menu, [&session, view](int percent) {
    const QString what = tr("Overlay opacity");
    session.change(what,
                   withFlatLooks(session.workspace(), view,
                                 [&](FlatLook& look) { look.overlayOpacity = percent / 100.0; }),
                   what);
  });
  QObject::connect(menu, &QMenu::aboutToHide, slider, [&session] { session.endGesture(); });
  auto* action = new QWidgetAction(menu);
  action->setDefaultWidget(slider);
  menu->addAction(action);
}

void fillOverlays(QMenu* menu, Session& session, const std::vector<const Series*>& all) {
  const ViewId view = flatViewInFocus(session.workspace());
  const ViewState& state = session.workspace().view(view);
  const FlatLook look = flatLookOf(state);
  const auto under = session.workspace().series.find(state.series);
  const auto set = [&session, view](const Series* over) {
    session.change(over ? tr("Overlay") : tr("Remove overlay"), withOverlay(session.workspace(), view, over));
  };
  QAction* none = menu->addAction(tr("None"), menu, [set] { set(nullptr); });
  none->setObjectName(QStringLiteral("noOverlay"));
  none->setCheckable(true);
  none->setChecked(look.overlay.empty());
  if (under == session.workspace().series.end()) return;
  const auto shown = session.workspace().series.find(look.overlay);
  for (const Series* over : all) {
    if (areTimePoints(*over, *under->second.series)) continue;
    const QString why = whyNotOverlaid(session.workspace(), *under->second.series, *over);
    const QString name = seriesText(*over).replace(QLatin1Char('&'), QStringLiteral("&&"));
    QAction* action = menu->addAction(why.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, why), menu,
                                      [set, series = *over] { set(&series); });
    action->setCheckable(true);
    action->setChecked(shown != session.workspace().series.end() &&
                       areTimePoints(*over, *shown->second.series));
    action->setEnabled(why.isEmpty());
  }
  if (look.overlay.empty()) return;
  menu->addSeparator();
  addColours(menu, "overlay_", look.overlayColours, [&session, view](ColourMap map) {
    session.change(tr("Overlay colours"),
                   withFlatLooks(session.workspace(), view, [&](FlatLook& l) { l.overlayColours = map; }));
  });
  menu->addSeparator();
  addOpacity(menu, session, view, look.overlayOpacity);
}

}  // namespace

QString colourMapText(ColourMap map) {
  switch (map) {
    case ColourMap::grey:
      return tr("Grey");
    case ColourMap::hotIron:
      return tr("Hot iron");
    case ColourMap::pet:
      return tr("PET");
    case ColourMap::rainbow:
      return tr("Rainbow (makes edges where there are none)");
  }
  return {};
}

ViewId flatViewInFocus(const Workspace& workspace) {
  if (isFlat(workspace.view(workspace.focus).kind)) return workspace.focus;
  const std::vector<ViewId> planes = planesOf(workspace, workspace.focus);
  return planes.empty() ? workspace.focus : planes.front();
}

QMenu* makeColourMenu(Session& session, QWidget* parent) {
  auto* menu = new QMenu(tr("Colour map"), parent);
  menu->setObjectName(QStringLiteral("colourMenu"));
  QObject::connect(menu, &QMenu::aboutToShow, menu, [menu, &session] {
    menu->clear();
    const SeriesKey shown = session.workspace().view(flatViewInFocus(session.workspace())).series;
    const auto state = session.workspace().series.find(shown);
    if (state == session.workspace().series.end()) {
      menu->addAction(tr("Open a series first."))->setEnabled(false);
      return;
    }
    addColours(menu, "colours_", state->second.colours, [&session, shown](ColourMap map) {
      session.change(tr("Colour map"), [&](Workspace& w) { w.series.edit(shown).colours = map; });
    });
  });
  return menu;
}

QMenu* makeOverlayMenu(Session& session, std::function<std::vector<const Series*>()> series,
                       QWidget* parent) {
  auto* menu = new QMenu(tr("Overlay"), parent);
  menu->setObjectName(QStringLiteral("overlayMenu"));
  QObject::connect(menu, &QMenu::aboutToShow, menu, [menu, &session, series = std::move(series)] {
    menu->clear();
    fillOverlays(menu, session, series());
  });
  return menu;
}

}  // namespace volumen
