#include "ui/panels/windows_dialog.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

enum OwnColumn { ownName, ownWidth, ownCentre, ownFor, ownColumns };

constexpr double largestNumber = 1e30;  // limit of values in volumes

// Parses a number with a decimal point or comma.
std::optional<double> typedNumber(QString text) {
  bool isNumber = false;
  const double number = text.trimmed().replace(u',', u'.').toDouble(&isNumber);
  return isNumber && std::abs(number) <= largestNumber ? std::optional(number) : std::nullopt;
}

// Returns modality and unit, such as "CT, HU".
QString forText(const OwnWindow& own) {
  QStringList parts{shownText(own.modality), shownText(own.unit)};
  parts.removeAll(QString());
  return parts.join(QStringLiteral(", "));
}

}  // namespace

WindowsDialog::WindowsDialog(Session& session, InUse inUse, QWidget* parent)
    : QDialog(parent),
      session_(session),
      inUse_(std::move(inUse)),
      table_(new QTableWidget(0, ownColumns)),
      note_(wrappedLabel(
          QStringLiteral("windowNote"),
          tr("Add takes the window of the slice or frame in focus. Each is offered for series of its "
             "modality and unit, behind the program's own."))) {
  setObjectName(QStringLiteral("windowsDialog"));
  setWindowTitle(tr("Windows"));
  table_->setObjectName(QStringLiteral("windowTable"));
  table_->setAccessibleName(tr("Windows of your own"));
  table_->setHorizontalHeaderLabels({tr("Name"), tr("Width"), tr("Centre"), tr("For")});
  table_->horizontalHeader()->setSectionResizeMode(ownName, QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  auto* column = new QVBoxLayout(this);
  column->addWidget(note_);
  column->addWidget(table_, 1);
  column->addWidget(makeButtons());
  resize(460, 320);
  connect(table_, &QTableWidget::cellChanged, this, &WindowsDialog::edit);
  whenChanged(session_, this, &WindowsDialog::showWindows, &Preferences::windows);
  showWindows();
}

QWidget* WindowsDialog::makeButtons() {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  addButton(*buttons, QStringLiteral("addWindow"), tr("Add"), [this] { add(); });
  addButton(*buttons, QStringLiteral("removeWindow"), tr("Remove"), [this] { remove(); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  return buttons;
}

void WindowsDialog::showWindows() {
  const QSignalBlocker quiet(table_);
  const OwnWindows& windows = session_.preferences().windows;
  table_->setRowCount(int(windows.size()));
  for (int row = 0; row < int(windows.size()); ++row) {
    const OwnWindow& own = windows[std::size_t(row)];
    const auto [width, centre] = windowNumbers(own.window);
    const QString texts[] = {own.name, width, centre, forText(own)};
    for (int column = 0; column < ownColumns; ++column) {
      // Reuses items, as one being edited is still in use.
      if (!table_->item(row, column)) table_->setItem(row, column, new QTableWidgetItem);
      QTableWidgetItem* cell = table_->item(row, column);
      cell->setText(texts[column]);
      if (column == ownFor) cell->setFlags(cell->flags() & ~Qt::ItemIsEditable);
    }
  }
}

// Adds the window in use and edits its name next.
void WindowsDialog::add() {
  std::optional<OwnWindow> own = inUse_();
  if (!own)
    return note_->setText(tr("Click a slice or a frame in grey first: its window is the one to add."));
  own->name = tr("My window %1").arg(session_.preferences().windows.size() + 1);
  session_.prefer([&](Preferences& p) { p.windows.push_back(*own); });
  table_->setCurrentCell(table_->rowCount() - 1, ownName);
  table_->editItem(table_->currentItem());
}

void WindowsDialog::remove() {
  const int row = table_->currentRow();
  if (row < 0) return note_->setText(tr("Choose the window to remove first."));
  session_.prefer([row](Preferences& p) { p.windows.erase(p.windows.begin() + row); });
}

// Restores the cell if the text is no valid name or number.
void WindowsDialog::edit(int row, int column) {
  OwnWindows windows = session_.preferences().windows;
  OwnWindow& own = windows[std::size_t(row)];
  const QString text = table_->item(row, column)->text().trimmed();
  const std::optional<double> number = typedNumber(text);
  if (column == ownName && !text.isEmpty()) own.name = text;
  if (column == ownWidth && number && *number > 0) own.window.width = *number;
  if (column == ownCentre && number) own.window.centre = *number;
  if (windows == session_.preferences().windows) return showWindows();
  session_.prefer([&](Preferences& p) { p.windows = windows; });
}

}  // namespace volumen
