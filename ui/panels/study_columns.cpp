#include "ui/panels/study_columns.h"

#include <QHeaderView>
#include <QMenu>
#include <QSettings>

#include "ui/data/study_list.h"

namespace volumen {

namespace {

struct ColumnRow {
  StudyColumn column;
  const char* word;    // used in settings
  const char* widest;  // text that must fit; null takes the remaining width
  bool isUsual;
};

constexpr ColumnRow columnTable[] = {{StudyColumn::name, "name", "Somebody, Anyone", true},
                                     {StudyColumn::id, "id", "01234567", true},
                                     {StudyColumn::date, "date", "0000-00-00", true},
                                     {StudyColumn::modality, "modality", "Modality", true},
                                     {StudyColumn::description, "description", nullptr, true},
                                     {StudyColumn::images, "images", "10,000", true},
                                     {StudyColumn::birthDate, "birthDate", "0000-00-00", false},
                                     {StudyColumn::sex, "sex", "Sex", false},
                                     {StudyColumn::accession, "accession", "Accession number", false},
                                     {StudyColumn::institution, "institution", "University Hospital", false}};

// The patient's name stays in every row.
bool canBeHidden(const ColumnRow& row) { return row.column != StudyColumn::name; }

QString settingOf(const ColumnRow& row) { return QStringLiteral("studyColumns/") + QLatin1String(row.word); }

}  // namespace

StudyColumns::StudyColumns(QHeaderView* header) : QObject(header), header_(header) {
  const QSettings settings;
  for (const ColumnRow& row : columnTable) {
    const int column = int(row.column);
    if (row.widest)
      header->resizeSection(column, header->fontMetrics().horizontalAdvance(QLatin1String(row.widest)) + 16);
    const bool shown = !canBeHidden(row) || settings.value(settingOf(row), row.isUsual).toBool();
    header->setSectionHidden(column, !shown);
  }
  header->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(header, &QWidget::customContextMenuRequested, this, [this](QPoint position) {
    auto* menu = new QMenu(header_);
    menu->setObjectName(QStringLiteral("columnsMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    addTo(menu);
    menu->popup(header_->mapToGlobal(position));
  });
}

void StudyColumns::addTo(QMenu* menu) {
  for (const ColumnRow& row : columnTable) {
    if (!canBeHidden(row)) continue;
    const int column = int(row.column);
    QAction* action = menu->addAction(header_->model()->headerData(column, Qt::Horizontal).toString());
    action->setCheckable(true);
    action->setChecked(!header_->isSectionHidden(column));
    connect(action, &QAction::toggled, this, [this, column](bool on) { show(column, on); });
  }
}

void StudyColumns::show(int column, bool shown) {
  header_->setSectionHidden(column, !shown);
  for (const ColumnRow& row : columnTable)
    if (int(row.column) == column) QSettings().setValue(settingOf(row), shown);
}

}  // namespace volumen
