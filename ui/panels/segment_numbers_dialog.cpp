#include "ui/panels/segment_numbers_dialog.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QSaveFile>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/numbers/csv.h"
#include "results/numbers/segment_columns.h"
#include "results/numbers/series_columns.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/frozen_column.h"
#include "ui/widgets/path_dialog.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/corner_text.h"

namespace volumen {

namespace {

constexpr int sortRole = Qt::UserRole, reportRole = Qt::UserRole + 1;

// Sorts numbers by size, missing ones first.
class NumberItem : public QTableWidgetItem {
 public:
  using QTableWidgetItem::QTableWidgetItem;
  bool operator<(const QTableWidgetItem& other) const override {
    const QVariant own = data(sortRole), others = other.data(sortRole);
    return own.isValid() && others.isValid() ? own.toDouble() < others.toDouble() : text() < other.text();
  }
};

QTableWidgetItem* nameItem(const Segment& segment, int report) {
  auto* item = new NumberItem(shownText(segment.label));
  item->setData(reportRole, report);
  return item;
}

// Makes a cell. If `isLater`, missing numbers may still be measured.
QTableWidgetItem* numberItem(const SegmentColumn& column, const SegmentReport& report, double factor,
                             bool isLater) {
  const std::vector<double> numbers = segmentNumbers(column, report, factor);
  auto* item =
      new NumberItem(isLater && numbers.empty() ? QStringLiteral("...") : columnText(column, report, factor));
  item->setData(sortRole, numbers.empty() ? -std::numeric_limits<double>::infinity() : numbers.front());
  item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  return item;
}

// Returns the available results, such as "Dice 0.8505, volume difference 0.2 ml, ...".
QString likenessText(const SegmentLikeness& alike) {
  const auto text = [](double number) { return digitsText(number, 4); };
  QStringList parts;
  if (alike.dice) parts << SegmentNumbersDialog::tr("Dice %1").arg(text(*alike.dice));
  if (alike.differenceMl)
    parts << SegmentNumbersDialog::tr("volume difference %1 ml").arg(text(*alike.differenceMl));
  if (alike.distances)
    parts << SegmentNumbersDialog::tr("Hausdorff distance %1 mm (95 %: %2 mm), mean surface distance %3 mm")
                 .arg(text(alike.distances->largest), text(alike.distances->p95),
                      text(alike.distances->mean));
  return parts.isEmpty() ? SegmentNumbersDialog::tr("both are empty") : parts.join(QStringLiteral(", "));
}

}  // namespace

SegmentNumbersDialog::SegmentNumbersDialog(Session& session, Jobs& jobs, const SegmentPainter& painter,
                                           QWidget* parent)
    : QDialog(parent),
      session_(session),
      painter_(painter),
      table_(new QTableWidget),
      charts_(new SegmentChartBox(session, jobs)),
      said_(wrappedLabel(QStringLiteral("segmentNumbersSaid"))),
      reports_(segmentReportsRule(session, painter, reports_, [this] { return isOpen_; }), session, &jobs),
      lane_(&jobs) {
  setObjectName(QStringLiteral("segmentNumbersDialog"));
  setWindowTitle(tr("Numbers of segments"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(1000, 640);
  makeLayout();
  connect(table_, &QTableWidget::itemSelectionChanged, this, &SegmentNumbersDialog::showChoice);
  connect(&session_, &Session::workspaceChanged, this, &SegmentNumbersDialog::follow);
  connect(&session_, &Session::preferencesChanged, this, &SegmentNumbersDialog::follow);
  // Queued, because after the stroke Esc still undoes the changes made since the press.
  connect(&painter_, &SegmentPainter::ended, this, &SegmentNumbersDialog::follow, Qt::QueuedConnection);
  connect(&reports_, &SegmentReports::changed, this, &SegmentNumbersDialog::follow);
  connect(this, &QDialog::finished, this, &SegmentNumbersDialog::end);
  fillTable();
  follow();
}

// Stops now, as a closed dialog is deleted only later by the event loop.
void SegmentNumbersDialog::end() {
  session_.disconnect(this);
  painter_.disconnect(this);
  reports_.disconnect(this);
  isOpen_ = false;
  reports_.update();
  lane_.giveUpAll();
  measured_ = {};
  fillTable();
}

void SegmentNumbersDialog::makeLayout() {
  table_->setObjectName(QStringLiteral("segmentNumbers"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setAlternatingRowColors(true);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSortIndicator(-1, Qt::AscendingOrder);  // sorted as in the list at first
  said_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  compare_ =
      addButton(*buttons, QStringLiteral("segmentNumbersCompare"), tr("Compare"), [this] { compare(); });
  copy_ = addButton(*buttons, QStringLiteral("segmentNumbersCopy"), tr("Copy"), [this] { copy(); });
  saveCsv_ = addButton(*buttons, QStringLiteral("segmentNumbersCsv"), tr("Save CSV..."),
                       [this] { askWhere(QStringLiteral("csv"), [this] { return csvText(); }); });
  saveJson_ = addButton(*buttons, QStringLiteral("segmentNumbersJson"), tr("Save JSON..."),
                        [this] { askWhere(QStringLiteral("json"), [this] { return jsonText(); }); });
  copy_->setToolTip(toolTipOf(tr("The chosen rows, else all, for a spreadsheet (Ctrl+C)")));
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* action = new QAction(tr("Copy"), table_);
  action->setShortcut(QKeySequence::Copy);
  action->setShortcutContext(Qt::WidgetShortcut);
  connect(action, &QAction::triggered, this, &SegmentNumbersDialog::copy);
  table_->addAction(action);
  table_->setContextMenuPolicy(Qt::ActionsContextMenu);
  (new FrozenColumn(table_))->setObjectName(QStringLiteral("segmentNames"));  // keeps names visible
  auto* column = new QVBoxLayout(this);
  column->addWidget(table_, 1);
  column->addWidget(charts_, 1);
  column->addWidget(said_);
  column->addWidget(buttons);
}

void SegmentNumbersDialog::follow() {
  if (painter_.isPainting()) return;
  reports_.update();
  const Measured before = std::exchange(measured_, measuredNow());
  if (before.said != measured_.said) said_->setText(measured_.said);
  if (before.source != measured_.source) lane_.giveUpAll();
  if (before.source != measured_.source || before.isDone != measured_.isDone ||
      before.maps != measured_.maps || before.scale != measured_.scale)
    fillTable();
}

SegmentNumbersDialog::Measured SegmentNumbersDialog::measuredNow() const {
  Measured now{copiesOf(allSegmentsShown(session_)), scale()};
  if (now.maps.empty()) {
    const QString why = whyNoSegments(session_);
    now.said = why.isEmpty() ? tr("There is no segment yet.") : why;
    return now;
  }
  const auto* voxels = reports_.find(segmentReportsKey(session_, false));
  const auto* surfaces = reports_.find(segmentReportsKey(session_, true));
  now.isDone = surfaces && surfaces->value;
  if (now.isDone || voxels) now.source = now.isDone ? surfaces->value : voxels->value;
  if (now.source) now.reports = *now.source;
  std::size_t n = 0;
  for (const SegmentMap& map : now.maps)
    for (const Segment& segment : map.segments)
      if (now.source) now.reports[n++].segment = segment;
  const auto* underWay = now.source ? surfaces : voxels;
  if (now.isDone) {
    const Series& series = session_.series()->series;
    now.said = seriesText(series) + unitNote(series);
  } else if (!underWay) {
    now.said = now.source ? tr("Measuring surfaces...") : tr("Measuring...");
  } else if (underWay->isCancelled) {
    now.said =
        now.source ? tr("Cancelled: surfaces were not measured.") : tr("Cancelled: nothing was measured.");
  } else {
    now.said = QString::fromStdString(underWay->whyNot);
  }
  return now;
}

void SegmentNumbersDialog::fillTable() {
  const ValueScale& shown = measured_.scale;
  table_->setSortingEnabled(false);  // otherwise rows would move while being filled
  table_->clear();
  QStringList heads{tr("Name")};
  for (const SegmentColumn& column : segmentColumns())
    heads << columnHead(column, shown).replace(QStringLiteral("mm^2"), QStringLiteral("mm\u00b2"));
  table_->setColumnCount(int(heads.size()));
  table_->setHorizontalHeaderLabels(heads);
  table_->setRowCount(int(measured_.reports.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const SegmentReport& report = measured_.reports[std::size_t(row)];
    table_->setItem(row, 0, nameItem(report.segment, row));
    int place = 1;
    for (const SegmentColumn& column : segmentColumns())
      table_->setItem(row, place++, numberItem(column, report, shown.factor, !measured_.isDone));
  }
  table_->setSortingEnabled(true);
  table_->resizeColumnsToContents();
  showChoice();
}

void SegmentNumbersDialog::showChoice() {
  const bool isThere = measured_.isDone;
  for (QPushButton* button : {copy_, saveCsv_, saveJson_}) button->setEnabled(isThere);
  compare_->setEnabled(isThere && chosenReports().size() == 2);
  compare_->setToolTip(toolTipOf(compare_->isEnabled()
                                     ? tr("Dice, difference of volumes and distances of the two surfaces")
                                     : tr("Choose two rows first (Ctrl+click).")));
  if (isThere)
    charts_->setMeasured(measured_.maps, measured_.reports, chosenReports());
  else
    charts_->setMeasured({}, {}, {});
}

void SegmentNumbersDialog::compare() {
  const std::vector<std::size_t> chosen = chosenReports();
  const SegmentReport &a = measured_.reports[chosen[0]], &b = measured_.reports[chosen[1]];
  const QString names = tr("%1 and %2").arg(shownText(a.segment.label), shownText(b.segment.label));
  lane_.giveUpAll();
  said_->setText(tr("Comparing..."));
  lane_.run(
      tr("Comparing segments"),
      [first = partOf(chosen[0]), second = partOf(chosen[1])](const Job& job) {
        return likeness(first.mask(), second.mask(), job.cancel());
      },
      [this, names](const Result<SegmentLikeness>& alike) {
        said_->setText(alike ? QStringLiteral("%1: %2.").arg(names, likenessText(*alike))
                             : QString::fromStdString(alike.message()));
      },
      [this] { said_->setText(tr("Cancelled: nothing was compared.")); });
}

// Returns the fields that identify the series in view.
QStringList SegmentNumbersDialog::ofSeries() const {
  if (!session_.series()) return {};
  const Series& series = session_.series()->series;
  return seriesFields(series, stepText(session_.workspace(), keyOf(series)));
}

// Copies heads and the selected rows, or all, in table order, followed by the fields of the series.
void SegmentNumbersDialog::copy() const {
  const QItemSelectionModel* chosen = table_->selectionModel();
  QStringList lines;
  for (int row = -1; row < table_->rowCount(); ++row) {
    if (row >= 0 && chosen->hasSelection() && !chosen->isRowSelected(row, {})) continue;
    QStringList cells;
    for (int column = 0; column < table_->columnCount(); ++column)
      cells << (row < 0 ? table_->horizontalHeaderItem(column) : table_->item(row, column))->text();
    cells.front() = harmlessName(cells.front());
    if (row >= 0) cells << ofSeries();
    for (const SeriesColumn& column : seriesColumns())
      if (row < 0) cells << tr(column.head);
    lines << cells.join(QLatin1Char('\t'));
  }
  QGuiApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

void SegmentNumbersDialog::askWhere(const QString& suffix, const std::function<QString()>& text) {
  const auto* dialog =
      openPathDialog(this, {"segmentNumbersFileDialog", tr("Save numbers"),
                            QStringLiteral("*.%1").arg(suffix), QStringLiteral("segments.%1").arg(suffix)});
  connect(dialog, &QFileDialog::fileSelected, this, [this, bytes = text().toUtf8()](const QString& path) {
    QSaveFile file(path);
    const bool isWritten =
        file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() && file.commit();
    said_->setText(isWritten ? tr("Saved %1").arg(path)
                             : tr("Cannot write %1: %2.").arg(path, file.errorString()));
  });
}

QString SegmentNumbersDialog::csvText() const {
  return segmentsAsCsv(measured_.reports, measured_.scale, ofSeries());
}

QString SegmentNumbersDialog::jsonText() const {
  nlohmann::ordered_json all{{"segments", segmentsJson(measured_.reports, measured_.scale.factor)},
                             {"unit", measured_.scale.unit},
                             {"of", identityJson(ofSeries())}};
  if (const SegmentsOverTime* values = charts_->overTime()) addTimePoints(all, *values);
  return QString::fromStdString(all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) +
         QLatin1Char('\n');
}

ValueScale SegmentNumbersDialog::scale() const {
  return session_.series() ? shownScale(session_.series()->series) : ValueScale{};
}

std::vector<std::size_t> SegmentNumbersDialog::chosenReports() const {
  std::vector<std::size_t> chosen;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows())
    chosen.push_back(index.data(reportRole).toUInt());
  return chosen;
}

SegmentNumbersDialog::Part SegmentNumbersDialog::partOf(std::size_t report) const {
  std::size_t behind = 0;
  for (const SegmentMap& map : measured_.maps) {
    behind += map.segments.size();
    if (report < behind) return {map.labels, measured_.reports[report].segment.number};
  }
  return {};
}

}  // namespace volumen
