#include "ui/features/menus.h"

#include <QAction>
#include <QCoreApplication>
#include <QMenuBar>
#include <QToolBar>
#include <algorithm>
#include <tuple>

#include "results/text/text.h"

namespace volumen {

Menus::Menus(QMainWindow& window) : toolBar_(window.addToolBar(tr("Tools"))) {
  const auto add = [&](const char* name, const QString& title) {
    QMenu* menu = window.menuBar()->addMenu(title);
    menu->setObjectName(QLatin1String(name));
    addMenu(menu, {});
    return menu;
  };
  file_ = add("fileMenu", tr("&File"));
  add("editMenu", tr("&Edit"));
  add("viewMenu", tr("&View"));
  add("toolsMenu", tr("&Tools"));
  add("segmentsMenu", tr("&Segments"));
  add("sceneMenu", tr("&3D"));
  add("helpMenu", tr("&Help"));
  toolBar_->setObjectName(QStringLiteral("tools"));
  toolBar_->setMovable(false);
  toolBar_->setIconSize({22, 22});
  bars_["toolBar"] = toolBar_;
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  addWidget(gap, {"toolBar", 30, toolBarGap});
}

void Menus::add(QAction* action, const std::vector<Place>& places) {
  for (const Place& place : places) entries_[place.bar].push_back({place, action});
}

void Menus::addWidget(QWidget* widget, const Place& place) {
  entries_[place.bar].push_back({place, nullptr, widget});
}

void Menus::addMenu(QMenu* menu, const std::vector<Place>& places) {
  bars_[menu->objectName().toStdString()] = menu;
  add(menu->menuAction(), places);
}

void Menus::fill() {
  for (const auto& [name, entries] : entries_) fill(bars_.at(name), entries);
}

void Menus::fill(QWidget* bar, std::vector<Entry> entries) {
  std::ranges::stable_sort(entries, {},
                           [](const Entry& e) { return std::tuple(e.place.group, e.place.order); });
  for (std::size_t n = 0; n < entries.size(); ++n) {
    if (n > 0 && entries[n].place.group != entries[n - 1].place.group) {
      auto* line = new QAction(bar);
      line->setSeparator(true);
      bar->addAction(line);
    }
    if (entries[n].widget)
      toolBar_->addWidget(entries[n].widget);
    else
      bar->addAction(entries[n].action);
  }
}

}  // namespace volumen
