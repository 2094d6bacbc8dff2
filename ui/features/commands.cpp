#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <algorithm>
#include <set>

#include "io/index/fold.h"
#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/features/key_table.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/command_list.h"

namespace volumen {

namespace {

// Something that can be searched for: an action, or a key that is none's.
struct Command {
  QAction* action = nullptr;
  CommandList::Row row;
  std::string folded{};  // what its words are looked for in
};

// All commands of the window by name, with where they stand in the menus and their keys.
class Commands : public Feature {
 public:
  explicit Commands(Workbench& bench);

 private:
  void open();
  void collect();
  void add(QAction* action, const QString& path);
  void addMenu(const QMenu& menu, const QString& path);
  void show(const QString& typed);
  void noteUse(QAction* action);

  CommandList* list_;
  std::vector<Command> all_;         // while the list is open
  std::set<const QAction*> wanted_;  // those that belong in it, but for those that are there
  std::vector<Command> shown_;
  std::vector<const QAction*> used_;  // the last one first
};

Commands::Commands(Workbench& bench) : Feature(bench), list_(new CommandList(&bench.window)) {
  bench_.addAction({"commands",
                    tr("Commands..."),
                    {tr("Ctrl+Shift+P")},
                    "",
                    false,
                    [this](bool) { open(); },
                    {{"helpMenu"}}});
  connect(list_, &CommandList::typed, this, &Commands::show);
  connect(list_, &CommandList::chosen, this, [this](int row) { shown_[std::size_t(row)].action->trigger(); });
  connect(&bench_, &Workbench::made, this, [this] {
    for (const auto& [name, action] : bench_.actions)
      connect(action, &QAction::triggered, this, [this, action = action] { noteUse(action); });
  });
}

void Commands::noteUse(QAction* action) {
  if (action == bench_.action("commands")) return;
  std::erase(used_, action);
  used_.insert(used_.begin(), action);
}

void Commands::open() {
  collect();
  QWidget* window = grid_.viewShown()->window();
  if (list_->parentWidget() != window) list_->setParent(window);
  list_->open();
}

// In the order of the menus, then what stands in none of them, then the keys.
void Commands::collect() {
  all_.clear();
  wanted_.clear();
  for (const auto& [name, action] : bench_.actions)
    if (!action->menu()) wanted_.insert(action);
  for (const auto& [name, dock] : bench_.docks) wanted_.insert(dock.widget->toggleViewAction());
  for (const QAction* title : bench_.window.menuBar()->actions())
    if (title->menu()) addMenu(*title->menu(), textOf(*title));
  for (const auto& [name, action] : bench_.actions) add(action, {});
  for (const KeyRow& row : keyRows())
    all_.push_back({nullptr, {row.text, tr("Mouse and keys"), row.keys, false}});
  for (Command& command : all_)
    command.folded = folded((command.row.text + QLatin1Char(' ') + command.row.path + QLatin1Char(' ') +
                             (command.action ? QString() : command.row.keys))
                                .toStdString());
}

void Commands::add(QAction* action, const QString& path) {
  if (wanted_.erase(action) == 0) return;
  all_.push_back({action, {textOf(*action), path, keysOf(*action), action->isEnabled()}});
}

void Commands::addMenu(const QMenu& menu, const QString& path) {
  for (QAction* action : menu.actions())
    if (action->menu())
      addMenu(*action->menu(), path + QStringLiteral(" > ") + textOf(*action));
    else
      add(action, path);
}

// Those in which every word is found; what was used last comes first where nothing is typed.
void Commands::show(const QString& typed) {
  const std::vector<std::string> words = foldedWords(typed.toStdString());
  const auto isFound = [&](const Command& command) {
    return std::ranges::all_of(
        words, [&](const std::string& word) { return command.folded.find(word) != std::string::npos; });
  };
  shown_.clear();
  std::ranges::copy_if(all_, std::back_inserter(shown_), isFound);
  const auto rank = [&](const Command& command) {
    return std::ranges::find(used_, command.action) - used_.begin();
  };
  if (words.empty()) std::ranges::stable_sort(shown_, {}, rank);
  std::vector<CommandList::Row> rows;
  for (const Command& command : shown_) rows.push_back(command.row);
  list_->setRows(rows);
}

}  // namespace

std::unique_ptr<Feature> makeCommands(Workbench& bench) { return std::make_unique<Commands>(bench); }

}  // namespace volumen
