#include "ui/panels/attributes_dialog.h"

#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QVBoxLayout>
#include <set>

#include "io/dicom/attribute_list.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// While names are hidden, numbers and codes alone are shown: text, dates and identifiers may name the
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

// From the leaves up: a line is shown with any of those below it, and all of those below one that is found.
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

AttributesDialog::AttributesDialog(const Series& series, QWidget* parent)
    : QDialog(parent),
      series_(series),
      slice_(new QSpinBox),
      search_(new QLineEdit),
      tree_(new QTreeWidget),
      file_(plainLabel()) {
  setObjectName(QStringLiteral("attributesDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("DICOM attributes - %1").arg(seriesText(series)));
  resize(760, 560);
  slice_->setObjectName(QStringLiteral("attributesSlice"));
  slice_->setAccessibleName(tr("Slice"));
  slice_->setRange(1, std::max(1, int(series.files.size())));
  slice_->setSuffix(tr(" of %1").arg(series.files.size()));
  slice_->setKeyboardTracking(false);
  search_->setObjectName(QStringLiteral("attributesSearch"));
  search_->setPlaceholderText(tr("Search tags, names and values"));
  search_->setClearButtonEnabled(true);
  tree_->setObjectName(QStringLiteral("attributesTree"));
  tree_->setHeaderLabels({tr("Tag"), tr("Name"), tr("VR"), tr("Value")});
  tree_->setUniformRowHeights(true);
  tree_->setAlternatingRowColors(true);
  file_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  makeLayout();
  connect(slice_, &QSpinBox::valueChanged, this, &AttributesDialog::read);
  connect(search_, &QLineEdit::textChanged, this, &AttributesDialog::filter);
  read();
  search_->setFocus();
}

void AttributesDialog::makeLayout() {
  auto* row = new QHBoxLayout;
  auto* label = plainLabel(tr("Slice"));
  label->setBuddy(slice_);
  row->addWidget(label);
  row->addWidget(slice_);
  row->addWidget(search_, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(row);
  column->addWidget(tree_, 1);
  column->addWidget(file_);
  column->addWidget(buttons);
  tree_->setColumnWidth(0, 170);
  tree_->setColumnWidth(1, 220);
  tree_->setColumnWidth(2, 44);
}

void AttributesDialog::read() {
  const std::string path = series_.files[std::size_t(slice_->value() - 1)];
  file_->setText(namesHidden() ? pathText(path) : QFileInfo(QString::fromStdString(path)).fileName());
  lane_.giveUpAll();
  lane_.run(
      {}, [path](const Job&) { return dicom::listAttributes(path); },
      [this, path](const auto& lines) {
        fill(tree_, lines ? *lines : std::vector<dicom::AttributeLine>{});
        if (!lines) file_->setText(QStringLiteral("%1: %2.").arg(pathText(path), shownText(lines.message())));
        filter();
      });
}

void AttributesDialog::filter() {
  for (int n = 0; n < tree_->topLevelItemCount(); ++n)
    showFound(tree_->topLevelItem(n), search_->text(), search_->text().isEmpty());
}

}  // namespace volumen
