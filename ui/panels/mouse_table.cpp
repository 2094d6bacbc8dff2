#include "ui/panels/mouse_table.h"

#include <QGridLayout>
#include <algorithm>

#include "ui/panels/sources.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

struct MouseLine {
  MouseInput input;
  QString text;
};

std::vector<MouseLine> mouseLines() {
  return {{MouseInput::left, MouseTable::tr("Left")},
          {MouseInput::middle, MouseTable::tr("Middle")},
          {MouseInput::right, MouseTable::tr("Right")},
          {MouseInput::wheel, MouseTable::tr("Wheel")},
          {MouseInput::move, MouseTable::tr("Pointer, no button")}};
}

struct MouseColumn {
  Qt::KeyboardModifier held;
  QString text;
};

std::vector<MouseColumn> mouseColumns() {
  return {{Qt::NoModifier, MouseTable::tr("Alone")},
          {Qt::ShiftModifier, MouseTable::tr("Shift")},
          {Qt::ControlModifier, MouseTable::tr("Ctrl")},
          {Qt::AltModifier, MouseTable::tr("Alt")}};
}

}  // namespace

MouseTable::MouseTable(Session& session, QWidget* parent) : QTabWidget(parent), session_(session) {
  setObjectName(QStringLiteral("mouseTable"));
  setAccessibleName(tr("Mouse buttons and wheel"));
  addTab(makePage(MousePlace::flat), tr("In slices and frames"));
  addTab(makePage(MousePlace::scene), tr("In 3D"));
}

QWidget* MouseTable::makePage(MousePlace place) {
  auto* page = new QWidget;
  auto* grid = new QGridLayout(page);
  const auto columns = mouseColumns();
  for (int n = 0; n < int(columns.size()); ++n)
    grid->addWidget(plainLabel(columns[std::size_t(n)].text), 0, n + 1);
  int row = 0;
  for (const MouseLine& line : mouseLines()) {
    ++row;
    const auto isOfLine = [&](const MouseSlot& slot) {
      return slot.place == place && slot.input == line.input;
    };
    if (std::ranges::none_of(mouseSlots(), isOfLine)) continue;
    grid->addWidget(plainLabel(line.text), row, 0);
    if (line.input == MouseInput::left) grid->addWidget(plainLabel(tr("The chosen tool")), row, 1);
  }
  for (const MouseSlot& slot : mouseSlots())
    if (slot.place == place) addBox(*grid, slot);
  return page;
}

void MouseTable::addBox(QGridLayout& grid, const MouseSlot& slot) {
  const auto lines = mouseLines();
  const auto columns = mouseColumns();
  const auto line = std::ranges::find(lines, slot.input, &MouseLine::input);
  const auto column = std::ranges::find(columns, slot.held, &MouseColumn::held);
  const std::vector<MouseAction>& actions = mouseActions(slot);
  QStringList texts;
  std::vector<std::string> words;
  for (const MouseAction& action : actions) texts << action.text, words.push_back(action.word);
  const Lens<Preferences, std::string> bound{
      [slot](const Preferences& p) { return boundTo(p, slot); },
      [slot](Preferences& p, const std::string& word) { p = withBound(p, slot, word); }};
  auto* box = choiceField({QString::fromStdString(wordOf(slot)),
                           slot.held ? tr("%1 with %2").arg(line->text, column->text) : line->text},
                          texts);
  grid.addWidget(preferencesSource(session_).bind(box, {}, among(bound, words)),
                 1 + int(line - lines.begin()), 1 + int(column - columns.begin()));
}

}  // namespace volumen
