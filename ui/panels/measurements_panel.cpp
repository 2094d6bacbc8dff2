#include "ui/panels/measurements_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QMenu>
#include <QSaveFile>
#include <QShortcut>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "results/numbers/series_columns.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/path_dialog.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/shape_json.h"

namespace volumen {

namespace {

enum { nameColumn, numberColumn, seriesColumn, placeColumn, timeColumn, dateColumn, patientColumn };
constexpr qint64 mostBytes = 16 << 20;  // limit for a file of shapes, as in `volumen measure`

}  // namespace

MeasurementsPanel::MeasurementsPanel(Session& session, MeasuredNumbers& measurer, QWidget* parent)
    : QWidget(parent),
      session_(session),
      measurer_(measurer),
      empty_(wrappedLabel(QStringLiteral("measurementsEmpty"),
                          tr("Choose a tool under Measure (D: length, E: ellipse), then drag in a slice."))),
      list_(new QTreeWidget),
      shown_(flagField({QStringLiteral("measurementsShown"), tr("Show"), tr("Show measurements in slices")})),
      rename_(buttonOf(QStringLiteral("measurementRename"), tr("Rename"),
                       [this] { list_->editItem(list_->currentItem(), nameColumn); })),
      delete_(buttonOf(QStringLiteral("measurementDelete"), tr("Delete"), [this] { deleteSelected(); })),
      deleteAll_(buttonOf(QStringLiteral("measurementDeleteAll"), tr("Delete all"),
                          [this] { deleteAllMeasurements(session_); })),
      copy_(menuButton("measurementCopy", tr("Copy"))),
      save_(menuButton("measurementSave", tr("Save"))),
      open_(buttonOf(QStringLiteral("measurementOpen"), tr("Open..."), [this] { askWhatToOpen(); })) {
  makeLayout();
  fillMenus();
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            // Equal workspaces mean that a series was loaded and can be measured.
            if (showsOther(before, after) || before.measurements != after.measurements ||
                before.selected != after.selected || before.measurementsShown != after.measurementsShown ||
                before == after)
              showAll();
          });
  connect(&session_, &Session::preferencesChanged, this, &MeasurementsPanel::showAll);
  connect(&measurer_, &MeasuredNumbers::changed, this, &MeasurementsPanel::showAll);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) session_.select(item->data(nameColumn, Qt::UserRole).toInt());
  });
  connect(list_, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item) {
    Q_EMIT jumpRequested(item->data(nameColumn, Qt::UserRole).toInt());
  });
  connect(list_, &QTreeWidget::itemChanged, this, &MeasurementsPanel::rename);
  connect(shown_, &QCheckBox::clicked, this, [this](bool on) { showMeasurements(session_, on); });
  auto* key = new QShortcut(Qt::Key_Delete, list_, nullptr, nullptr, Qt::WidgetShortcut);
  connect(key, &QShortcut::activated, this, &MeasurementsPanel::deleteSelected);
  showAll();
}

void MeasurementsPanel::makeLayout() {
  list_->setObjectName(QStringLiteral("measurementList"));
  list_->setAccessibleName(tr("Measurements"));
  list_->setHeaderLabels({tr("Name"), tr("Number"), tr("Series"), tr("Place"), tr("Time point"),
                          tr("Study date"), tr("Patient")});
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed);
  list_->header()->setStretchLastSection(false);
  for (const auto& [column, width] : {std::pair(nameColumn, 80), std::pair(numberColumn, 100)})
    list_->header()->resizeSection(column, width);
  for (const int column : {seriesColumn, placeColumn, timeColumn, dateColumn, patientColumn})
    list_->header()->resizeSection(column, 70);
  list_->setMinimumHeight(60);
  open_->setToolTip(tr("Add the shapes of a file to the series in focus"));
  stack(this,
        {empty_,
         {list_, 1},
         lineOf({shown_, rename_, delete_, deleteAll_, {}}),
         lineOf({copy_, save_, open_, {}})},
        8);
}

QToolButton* MeasurementsPanel::menuButton(const char* name, const QString& text) {
  QToolButton* made = buttonOf(QLatin1String(name), text);
  made->setPopupMode(QToolButton::InstantPopup);
  made->setMenu(new QMenu(made));
  return made;
}

void MeasurementsPanel::fillMenus() {
  const auto add = [](QToolButton* to, const char* name, const QString& text, auto run) {
    to->menu()->addAction(text, to, run)->setObjectName(QLatin1String(name));
  };
  add(copy_, "copyMeasurementsText", tr("As text"), [this] { copy(measurementsAsText(rows())); });
  add(copy_, "copyMeasurementsCsv", tr("As CSV"), [this] { copy(measurementsAsCsv(rows())); });
  add(save_, "saveMeasurementsCsv", tr("Numbers as CSV..."), [this] {
    askWhere(tr("Save numbers"), QStringLiteral("csv"), [this] { return measurementsAsCsv(rows()); });
  });
  add(save_, "saveShapes", tr("Shapes of the series in focus as JSON..."),
      [this] { askWhere(tr("Save shapes"), QStringLiteral("json"), [this] { return shapesText(); }); });
}

// Reuses row items, so that a name being typed stays in its field.
void MeasurementsPanel::showAll() {
  const Workspace& workspace = session_.workspace();
  const QSignalBlocker quiet(list_);
  const int count = int(workspace.measurements.size());
  while (list_->topLevelItemCount() > count) delete list_->takeTopLevelItem(count);
  QTreeWidgetItem* selected = nullptr;
  for (int n = 0; n < count; ++n) {
    QTreeWidgetItem* item = list_->topLevelItem(n);
    if (!item) item = new QTreeWidgetItem(list_);
    const Measurement& m = workspace.measurements[std::size_t(n)];
    showRow(item, m);
    if (m.id == workspace.selected) selected = item;
  }
  list_->setCurrentItem(selected);
  const auto isOfStep = [&](const Measurement& m) { return !stepText(workspace, m.series).isEmpty(); };
  list_->setColumnHidden(timeColumn, std::ranges::none_of(workspace.measurements, isOfStep));
  empty_->setVisible(count == 0);
  list_->setVisible(count > 0);
  shown_->setChecked(workspace.measurementsShown);
  for (QWidget* part : {static_cast<QWidget*>(shown_), static_cast<QWidget*>(deleteAll_),
                        static_cast<QWidget*>(copy_), static_cast<QWidget*>(save_)})
    part->setEnabled(count > 0);
  for (QToolButton* part : {rename_, delete_}) part->setEnabled(selected != nullptr);
  open_->setEnabled(!seriesInFocus().empty());
}

void MeasurementsPanel::showRow(QTreeWidgetItem* item, const Measurement& measurement) {
  const auto state = session_.workspace().series.find(measurement.series);
  const MeasuredPtr numbers = measurer_.numbersOf(measurement);
  const QString number = numbers ? measuredText(measurement.shape, *numbers) : tr("not measured yet");
  item->setFlags(item->flags() | Qt::ItemIsEditable);
  item->setData(nameColumn, Qt::UserRole, measurement.id);
  item->setText(nameColumn, nameText(measurement));
  item->setToolTip(nameColumn, toolTipOf(nameText(measurement)));
  item->setText(numberColumn, number);
  item->setToolTip(numberColumn, toolTipOf(number));
  if (state == session_.workspace().series.end()) return;
  const Series& series = *state->second.series;
  const std::pair<int, QString> texts[] = {{seriesColumn, sourceText(measurement, series)},
                                           {placeColumn, whereText(measurement, series)},
                                           {timeColumn, stepText(session_.workspace(), measurement.series)},
                                           {dateColumn, dateText(series.studyDate)},
                                           {patientColumn, patientText(series)}};
  for (const auto& [column, text] : texts) {
    item->setText(column, text);
    item->setToolTip(column, toolTipOf(text));
  }
}

void MeasurementsPanel::deleteSelected() {
  if (selectedId() > 0) deleteMeasurement(session_, selectedId());
}

int MeasurementsPanel::selectedId() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? item->data(nameColumn, Qt::UserRole).toInt() : 0;
}

std::vector<MeasuredRow> MeasurementsPanel::rows() {
  const Workspace& workspace = session_.workspace();
  std::vector<MeasuredRow> rows;
  held_.clear();
  for (const Measurement& m : workspace.measurements) {
    const auto state = workspace.series.find(m.series);
    held_.push_back(measurer_.exactNumbersOf(m));
    rows.push_back({m, held_.back().get(),
                    state == workspace.series.end() ? nullptr : state->second.series.get(),
                    stepText(workspace, m.series)});
  }
  return rows;
}

// Does not store the default name as the user's.
void MeasurementsPanel::rename(QTreeWidgetItem* item) {
  const int id = item->data(nameColumn, Qt::UserRole).toInt();
  const Measurement* m = findMeasurement(session_.workspace(), id);
  if (m && item->text(nameColumn) != nameText(*m))
    renameMeasurement(session_, id, item->text(nameColumn));
  else
    showAll();
}

void MeasurementsPanel::copy(const QString& text) { QGuiApplication::clipboard()->setText(text); }

SeriesKey MeasurementsPanel::seriesInFocus() const {
  return session_.workspace().view(session_.workspace().focus).series;
}

QString MeasurementsPanel::shapesText() const {
  std::vector<Shape> shapes;
  for (const Measurement& m : session_.workspace().measurements)
    if (m.series == seriesInFocus()) shapes.push_back(m.shape);
  std::vector<std::pair<std::string, std::string>> whose;
  if (const Series* series = seriesIn(session_.workspace(), session_.workspace().focus)) {
    const QStringList fields = seriesFields(*series, stepText(session_.workspace(), seriesInFocus()));
    for (std::size_t n = 0; n < seriesColumns().size(); ++n)
      if (const QString& text = fields[qsizetype(n)]; !text.isEmpty())
        whose.emplace_back(seriesColumns()[n].key, text.toStdString());
  }
  return QString::fromStdString(shapesToJson(shapes, whose));
}

void MeasurementsPanel::askWhere(const QString& title, const QString& suffix,
                                 const std::function<QString()>& text) {
  const auto* dialog =
      openPathDialog(this, {"measurementSaveDialog", title, QStringLiteral("*.%1").arg(suffix),
                            QStringLiteral("measurements.%1").arg(suffix)});
  connect(dialog, &QFileDialog::fileSelected, this, [this, bytes = text().toUtf8()](const QString& path) {
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
      Q_EMIT failed(tr("Cannot write %1: %2.").arg(path, file.errorString()));
    else
      Q_EMIT saved(path);
  });
}

void MeasurementsPanel::askWhatToOpen() {
  const auto* dialog = openPathDialog(
      this,
      {"measurementOpenDialog", tr("Open shapes"), QStringLiteral("*.json"), {}, QFileDialog::ExistingFile});
  connect(dialog, &QFileDialog::fileSelected, this, &MeasurementsPanel::openShapes);
}

void MeasurementsPanel::openShapes(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly))
    return Q_EMIT failed(tr("Cannot read %1: %2.").arg(path, file.errorString()));
  if (file.size() > mostBytes) return Q_EMIT failed(tr("Cannot read %1: it is larger than 16 MB.").arg(path));
  const Result<std::vector<Shape>> shapes = shapesFromJson(file.readAll().toStdString());
  if (!shapes)
    return Q_EMIT failed(QStringLiteral("%1: %2").arg(path, QString::fromStdString(shapes.message())));
  addMeasurements(session_, seriesInFocus(), *shapes);
}

}  // namespace volumen
