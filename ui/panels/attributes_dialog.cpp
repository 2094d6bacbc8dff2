#include "ui/panels/attributes_dialog.h"

#include <QAction>
#include <QClipboard>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHeaderView>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>
#include <algorithm>
#include <set>
#include <utility>

#include "results/text/text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/picture_in_focus.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// While names are hidden, only numbers and codes are shown, as text, dates and identifiers may name the
// patient.
QString valueText(const dicom::AttributeLine& line) {
  static const std::set<std::string> kept{"US", "SS", "UL", "SL", "UV", "SV", "FL", "FD", "DS",
                                          "IS", "CS", "AT", "SQ", "OB", "OW", "OF", "OD", "OL"};
  return namesHidden() && !kept.contains(line.vr) ? AttributesDialog::tr("(hidden)") : shownText(line.value);
}

QTreeWidgetItem* itemOf(const dicom::AttributeLine& line) {
  return new QTreeWidgetItem(
      {shownText(line.tag), shownText(line.name), shownText(line.vr), valueText(line)});
}

void fill(QTreeWidget* tree, const std::vector<dicom::AttributeLine>& lines) {
  tree->clear();
  std::vector<QTreeWidgetItem*> parents{tree->invisibleRootItem()};
  for (const dicom::AttributeLine& line : lines) {
    parents.resize(std::size_t(line.depth) + 1);
    QTreeWidgetItem* item = itemOf(line);
    parents.back()->addChild(item);
    parents.push_back(item);
  }
  tree->expandAll();
}

// Returns the columns separated by tabs, with a ">" for each enclosing sequence.
QString rowText(const QTreeWidgetItem& item) {
  QStringList cells;
  for (int column = 0; column < item.columnCount(); ++column) cells << item.text(column);
  for (const QTreeWidgetItem* above = item.parent(); above; above = above->parent())
    cells.front().prepend(QLatin1Char('>'));
  return cells.join(QLatin1Char('\t'));
}

// Shows matching lines with all lines above and below them. Works from the leaves up.
bool showFound(QTreeWidgetItem* item, const QString& text, bool all) {
  bool found = all;
  for (int column = 0; column < item->columnCount(); ++column)
    found = found || item->text(column).contains(text, Qt::CaseInsensitive);
  bool any = found;
  for (int n = 0; n < item->childCount(); ++n) any = showFound(item->child(n), text, found) || any;
  item->setHidden(!any);
  return any;
}

}  // namespace

AttributesDialog::AttributesDialog(Session& session, const Series& series, QWidget* parent)
    : QDialog(parent),
      session_(session),
      slice_(wholeField({QStringLiteral("attributesSlice"), tr("Slice")}, 1, 1)),
      follow_(flagField({QStringLiteral("attributesFollow"), tr("Follow the view")})),
      search_(new QLineEdit),
      tree_(new QTreeWidget),
      file_(plainLabel()) {
  setObjectName(QStringLiteral("attributesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(760, 560);
  slice_->setKeyboardTracking(false);
  search_->setObjectName(QStringLiteral("attributesSearch"));
  search_->setPlaceholderText(tr("Search tags, names and values"));
  search_->setClearButtonEnabled(true);
  tree_->setObjectName(QStringLiteral("attributesTree"));
  tree_->setHeaderLabels({tr("Tag"), tr("Name"), tr("VR"), tr("Value")});
  tree_->setUniformRowHeights(true);
  tree_->setAlternatingRowColors(true);
  tree_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  file_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  makeLayout();
  makeCopying();
  const Workspace& workspace = session_.workspace();
  const Series* inFocus = seriesIn(workspace, workspace.focus);
  const bool isInFocus = inFocus && keyOf(*inFocus) == keyOf(series);
  follow_->setChecked(isInFocus);
  showPicture(series, isInFocus ? pictureOf(workspace, workspace.focus).value_or(0) : 0);
  connect(slice_, &QSpinBox::valueChanged, this, [this] {
    follow_->setChecked(false);
    read();
  });
  connect(follow_, &QCheckBox::toggled, this, &AttributesDialog::follow);
  whenChanged(session_, this, &AttributesDialog::follow,
              [](const Workspace& w) { return std::pair(w.view(w.focus).series, pictureOf(w, w.focus)); });
  whenChanged(session_, this, &AttributesDialog::showNamesOrNot, &Preferences::hideNames);
  connect(search_, &QLineEdit::textChanged, this, &AttributesDialog::filter);
  search_->setFocus();
}

void AttributesDialog::makeLayout() {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  addButton(*buttons, QStringLiteral("attributesCopyAll"), tr("Copy all"), [this] {
    copy(false);
  })->setToolTip(toolTipOf(tr("All rows that are shown, with tabs between their columns")));
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(lineOf({captionOf(tr("Slice"), slice_), slice_, follow_, {search_, 1}}, -1));
  column->addWidget(tree_, 1);
  column->addWidget(file_);
  column->addWidget(buttons);
  tree_->setColumnWidth(0, 170);
  tree_->setColumnWidth(1, 220);
  tree_->setColumnWidth(2, 44);
}

void AttributesDialog::makeCopying() {
  auto* action = new QAction(tr("Copy rows"), tree_);
  action->setShortcut(QKeySequence::Copy);
  action->setShortcutContext(Qt::WidgetShortcut);
  connect(action, &QAction::triggered, this, [this] { copy(true); });
  tree_->addAction(action);
  tree_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

// Shows the picture in focus if it has attributes.
void AttributesDialog::follow() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  if (!follow_->isChecked() || !series || series->format != "DICOM" || series->files.empty()) return;
  showPicture(*series, pictureOf(workspace, workspace.focus).value_or(0));
}

void AttributesDialog::showPicture(const Series& series, int index) {
  const QSignalBlocker quiet(slice_);
  if (keyOf(series) != keyOf(series_)) {
    series_ = series;
    showTitle();
    slice_->setRange(1, std::max(1, int(series.files.size())));
    slice_->setSuffix(tr(" of %1").arg(series.files.size()));
  }
  slice_->setValue(index + 1);
  read();
}

void AttributesDialog::showTitle() { setWindowTitle(tr("DICOM attributes - %1").arg(seriesText(series_))); }

// Clears the tree at once, so that no name stays until the file is read again.
void AttributesDialog::showNamesOrNot() {
  showTitle();
  tree_->clear();
  path_.clear();
  read();
}

void AttributesDialog::read() {
  if (series_.files.empty()) return;
  const std::string path = series_.files[std::size_t(slice_->value() - 1)];
  if (std::exchange(path_, path) == path) return;
  file_->setText(namesHidden() ? pathText(path) : QFileInfo(QString::fromStdString(path)).fileName());
  lane_.giveUpAll();
  lane_.run(
      {}, [path](const Job&) { return dicom::listAttributes(path); },
      [this, path](const auto& lines) {
        showLines(lines ? *lines : std::vector<dicom::AttributeLine>{});
        if (!lines) file_->setText(QStringLiteral("%1: %2.").arg(pathText(path), shownText(lines.message())));
      });
}

// Keeps the scroll position of the picture before.
void AttributesDialog::showLines(const std::vector<dicom::AttributeLine>& lines) {
  const int scrolled = tree_->verticalScrollBar()->value();
  fill(tree_, lines);
  filter();
  tree_->verticalScrollBar()->setValue(scrolled);
}

// Copies the visible lines in order.
void AttributesDialog::copy(bool onlyChosen) const {
  QStringList rows;
  for (QTreeWidgetItemIterator it(tree_, QTreeWidgetItemIterator::NotHidden); *it; ++it)
    if (!onlyChosen || (*it)->isSelected()) rows << rowText(**it);
  if (!rows.isEmpty()) QGuiApplication::clipboard()->setText(rows.join(QLatin1Char('\n')));
}

void AttributesDialog::filter() {
  for (int n = 0; n < tree_->topLevelItemCount(); ++n)
    showFound(tree_->topLevelItem(n), search_->text(), search_->text().isEmpty());
}

}  // namespace volumen
