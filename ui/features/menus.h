#pragma once

#include <QMainWindow>
#include <map>
#include <string>
#include <vector>

class QAction;
class QMenu;
class QToolBar;

namespace volumen {

/// The place of an entry in the menus or the tool bar. Lines separate the groups. Within a group entries are
/// sorted by `order`, then by time of addition.
struct Place {
  const char* bar;  ///< a menu of the menu bar ("fileMenu"), a menu of a feature, or "toolBar"
  int group = 0;
  int order = 0;
};

/// Order of the gap in the tool bar's last group. Entries with a higher order stand at its right end.
constexpr int toolBarGap = 100;

/// The menus and the tool bar of the window. Entries are collected with their places, and fill() inserts
/// them.
class Menus {
 public:
  explicit Menus(QMainWindow& window);

  /// Returns the File menu.
  QMenu* file() const { return file_; }

  void add(QAction* action, const std::vector<Place>& places);
  void addWidget(QWidget* widget, const Place& place);
  /// Adds a menu that others may extend by its object name.
  void addMenu(QMenu* menu, const std::vector<Place>& places);
  /// Inserts all entries. Throws std::out_of_range if a place names an unknown bar.
  void fill();

 private:
  // Holds either an action or a widget.
  struct Entry {
    Place place;
    QAction* action = nullptr;
    QWidget* widget = nullptr;
  };
  void fill(QWidget* bar, std::vector<Entry> entries);

  QToolBar* toolBar_;
  QMenu* file_;
  std::map<std::string, QWidget*> bars_;
  std::map<std::string, std::vector<Entry>> entries_;  // by name of the bar
};

}  // namespace volumen
