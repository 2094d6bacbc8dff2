#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <algorithm>
#include <set>

#include "io/index/fold.h"
#include "ui/features/action_text.h"
#include "ui/features/command_words.h"
#include "ui/features/feature.h"
#include "ui/features/key_table.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/command_list.h"

namespace volumen {

namespace {

// A searchable entry: an action, or a key that belongs to no action.
struct Command {
  QPointer<QAction> action;
  CommandList::Row row;
  // Search texts, case-folded: its own words, then these with other programs' words.
  std::string folded{};
  std::string withOthers{};
};

// Lists all commands of the window by name, with their menu paths and keys.
class Commands : public Feature {
 public:
  explicit Commands(Workbench& bench);

 private:
  void open();
  void collect();
  void add(QAction* action, const QString& path);
  void addMenu(QMenu& menu, const QString& path);
  void run(const Command& chosen);
  void show(const QString& typed);
  void noteUse(QAction* action);

  CommandList* list_;
  QMenu more_;                // commands that no menu of the window has
  std::vector<Command> all_;  // valid while the list is open
  // Actions of features, by name. The list includes them even if disabled.
  std::map<const QAction*, QString> own_;
  std::set<const QAction*> taken_;  // actions already in the list
  std::vector<Command> shown_;
  std::vector<const QAction*> used_;  // most recent first
};

Commands::Commands(Workbench& bench) : Feature(bench), list_(new CommandList(&bench.window)) {
  bench_.shared.commands = bench_.addAction({"commands",
                                             tr("Commands..."),
                                             {tr("Ctrl+Shift+P")},
                                             "",
                                             false,
                                             [this](bool) { open(); },
                                             {{"helpMenu"}}});
  connect(list_, &CommandList::typed, this, &Commands::show);
  connect(list_, &CommandList::chosen, this, [this](int row) { run(Command(shown_[std::size_t(row)])); });
  connect(&bench_, &Workbench::made, this, [this] {
    for (const auto& [name, action] : bench_.actions)
      connect(action, &QAction::triggered, this, [this, action = action] { noteUse(action); });
  });
}

void Commands::noteUse(QAction* action) {
  if (action == bench_.shared.commands) return;
  std::erase(used_, action);
  used_.insert(used_.begin(), action);
}

void Commands::open() {
  collect();
  list_->openIn(bench_.dialogParent());
}

// Collects the menus in order, then commands outside the menus, then keys.
void Commands::collect() {
  all_.clear();
  own_.clear();
  taken_.clear();
  for (const auto& [name, action] : bench_.actions)
    if (!action->menu()) own_[action] = name;
  for (const auto& [name, dock] : bench_.docks)
    own_[dock.widget->toggleViewAction()] = dock.widget->objectName();
  for (const QAction* title : bench_.window.menuBar()->actions())
    if (title->menu()) addMenu(*title->menu(), textOf(*title));
  for (QObject* menu : QObjectList(more_.children()))
    if (qobject_cast<QMenu*>(menu)) delete menu;
  Q_EMIT bench_.commandsOpen(&more_);
  for (QAction* action : more_.actions()) addMenu(*action->menu(), textOf(*action));
  for (const auto& [name, action] : bench_.actions) add(action, {});
  for (const KeyRow& row : keyRows())
    all_.push_back({nullptr, {row.text, tr("Mouse and keys"), row.keys, false}});
  for (Command& command : all_) {
    command.folded = folded((command.row.text + QLatin1Char(' ') + command.row.path + QLatin1Char(' ') +
                             (command.action ? QString() : command.row.keys))
                                .toStdString());
    const auto name = own_.find(command.action.data());
    const QString others = name == own_.end() ? QString() : otherWordsFor(name->second);
    command.withOthers = command.folded + ' ' + folded(others.toStdString());
  }
}

// Skips disabled entries that menus generate, as they only explain an empty menu.
void Commands::add(QAction* action, const QString& path) {
  const bool isOwn = own_.contains(action);
  if (action->menu() || action->isSeparator() || (!isOwn && !action->isEnabled())) return;
  if (textOf(*action).isEmpty() || !taken_.insert(action).second) return;
  all_.push_back({action, {textOf(*action), path, keysOf(*action), action->isEnabled()}});
}

void Commands::addMenu(QMenu& menu, const QString& path) {
  Q_EMIT menu.aboutToShow();  // fills the menu
  for (QAction* action : menu.actions())
    if (action->menu())
      addMenu(*action->menu(), path + QStringLiteral(" > ") + textOf(*action));
    else
      add(action, path);
}

// If the menu has been refilled meanwhile, triggers its new action with the same name.
void Commands::run(const Command& chosen) {
  if (chosen.action) return chosen.action->trigger();
  collect();
  for (const Command& command : all_)
    if (command.action && command.row.text == chosen.row.text && command.row.path == chosen.row.path)
      return command.action->trigger();
}

// Shows commands that contain every word, those that match by their own name first. Without words, recently
// used commands come first.
void Commands::show(const QString& typed) {
  const std::vector<std::string> words = foldedWords(typed.toStdString());
  const auto isIn = [&](const std::string& text) {
    return std::ranges::all_of(words,
                               [&](const std::string& word) { return text.find(word) != std::string::npos; });
  };
  shown_.clear();
  std::ranges::copy_if(all_, std::back_inserter(shown_), isIn, &Command::withOthers);
  std::ranges::stable_partition(shown_, isIn, &Command::folded);
  const auto rank = [&](const Command& command) {
    return std::ranges::find(used_, command.action.data()) - used_.begin();
  };
  if (words.empty()) std::ranges::stable_sort(shown_, {}, rank);
  std::vector<CommandList::Row> rows;
  for (const Command& command : shown_) rows.push_back(command.row);
  list_->setRows(rows);
}

}  // namespace

std::unique_ptr<Feature> makeCommands(Workbench& bench) { return std::make_unique<Commands>(bench); }

}  // namespace volumen
