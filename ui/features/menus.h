#pragma once

#include <QMainWindow>
#include <map>
#include <string>
#include <vector>

class QAction;
class QMenu;
class QToolBar;

namespace volumen {

/// Where something stands in the menus or the tool bar: in groups, which lines separate, and in its group by
/// `order`; what has one order as it was added.
struct Place {
  const char*
      bar;  ///< a menu of the menu bar ("fileMenu", "toolsMenu"), one that a feature adds, or "toolBar"
  int group = 0;
  int order = 0;
};

/// In the last group of the tool bar: what stands at its right end has a higher order.
constexpr int toolBarGap = 100;

/// The menus and the tool bar of the window. All that is added says where it stands; fill() puts it there.
class Menus {
 public:
  explicit Menus(QMainWindow& window);

  void add(QAction* action, const std::vector<Place>& places);
  void addWidget(QWidget* widget, const Place& place);
  /// A menu that others may add to by its object name.
  void addMenu(QMenu* menu, const std::vector<Place>& places);
  /// Once all of it is known. Throws std::out_of_range where a place names no bar.
  void fill();

 private:
  // One of the two.
  struct Entry {
    Place place;
    QAction* action = nullptr;
    QWidget* widget = nullptr;
  };
  void fill(QWidget* bar, std::vector<Entry> entries);

  QToolBar* toolBar_;
  std::map<std::string, QWidget*> bars_;
  std::map<std::string, std::vector<Entry>> entries_;  // by bar
};

}  // namespace volumen
