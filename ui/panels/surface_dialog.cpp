#include "ui/panels/surface_dialog.h"

#include <QFormLayout>
#include <QHeaderView>
#include <QTableWidget>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_jobs.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr double leastMm = 0.01, mostMm = 100, usualMm = 0.1;

QStringList surfaceHeads(bool isReduced) {
  QStringList heads{SurfaceDialog::tr("Segment"), SurfaceDialog::tr("Triangles"),
                    SurfaceDialog::tr("Voxels (ml)"), SurfaceDialog::tr("Inside (ml)"),
                    SurfaceDialog::tr("Area (cm\u00b2)")};
  if (isReduced)
    heads << SurfaceDialog::tr("Triangles before") << SurfaceDialog::tr("Inside before (ml)")
          << SurfaceDialog::tr("Off at most (mm)");
  return heads << SurfaceDialog::tr("Closed shells");
}

// Returns cells in the order of the heads.
QStringList surfaceCells(const SurfaceToWrite& of) {
  const auto text = [](double number) { return digitsText(number, 4); };
  QStringList cells{shownText(of.name), QString::number(qulonglong(of.surface.triangles.size())),
                    text(of.voxelsMl), text(of.insideMl), text(of.areaCm2)};
  if (of.before)
    cells << QString::number(qulonglong(of.before->triangles)) << text(of.before->insideMl)
          << digitsText(of.before->offMm, 2);
  return cells << QString::number(qulonglong(of.shells));
}

}  // namespace

SurfaceDialog::SurfaceDialog(std::vector<SegmentMap> maps, Jobs& jobs, QWidget* parent)
    : QDialog(parent),
      maps_(std::move(maps)),
      files_(choiceField({QStringLiteral("surfaceFiles"), tr("Files")},
                         {tr("A file a segment"), tr("One file")})),
      reduce_(flagField({QStringLiteral("surfaceReduce"), tr("Fewer triangles, off by at most")})),
      byMm_(numberField({QStringLiteral("surfaceReduceMm"), reduce_->text()},
                        {.low = leastMm, .high = mostMm, .suffix = tr(" mm")})),
      largest_(flagField({QStringLiteral("surfaceLargest"), tr("Largest part of each segment alone"),
                          tr("Leaves out what no faces of voxels join to it: loose parts of a print")})),
      table_(new QTableWidget),
      said_(wrappedLabel(QStringLiteral("surfaceSaid"))),
      lane_(&jobs) {
  setObjectName(QStringLiteral("surfaceDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Surfaces"));
  resize(760, 400);
  auto* form = new QFormLayout;
  addChoices(*form);
  table_->setObjectName(QStringLiteral("surfaceTable"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->verticalHeader()->hide();
  auto* buttons = new QDialogButtonBox;
  save_ = addAccept(*this, *buttons, QStringLiteral("surfaceSave"), tr("Save"));
  auto* column = new QVBoxLayout(this);
  column->addLayout(form);
  column->addWidget(table_, 1);
  column->addWidget(said_);
  column->addWidget(buttons);
  make();
}

void SurfaceDialog::addChoices(QFormLayout& form) {
  byMm_->setButtonSymbols(QAbstractSpinBox::UpDownArrows);
  byMm_->setValue(usualMm);
  byMm_->setSingleStep(usualMm);
  byMm_->setEnabled(false);
  largest_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);  // no wider than its clickable area
  form.addRow(tr("Files"), files_);
  form.addRow(reduce_, byMm_);
  form.addRow(largest_);
  form.setRowVisible(files_, maps_.size() > 1 || maps_.front().segments.size() > 1);
  connect(reduce_, &QCheckBox::toggled, this, [this](bool on) {
    byMm_->setEnabled(on);
    make();
  });
  connect(byMm_, &QDoubleSpinBox::valueChanged, this, &SurfaceDialog::make);
  connect(largest_, &QCheckBox::toggled, this, &SurfaceDialog::make);
}

SurfaceWriting SurfaceDialog::writing() const {
  return {reduce_->isChecked() ? byMm_->value() : 0, files_->currentIndex() == 1};
}

void SurfaceDialog::make() {
  lane_.giveUpAll();
  surfaces_.reset();
  fillTable();
  said_->setText(tr("Making the surfaces..."));
  lane_.run(
      tr("Making surfaces"),
      [maps = maps_, byMm = writing().reducedByMm, isLargest = largest_->isChecked()](const Job& job) {
        std::vector<Segmented> segments = segmentedOf(maps);
        if (isLargest)
          for (Segmented& map : segments) map = withLargestParts(map, job.cancel());
        return surfacesToWrite(segments, byMm, job.cancel());
      },
      [this](Result<std::vector<SurfaceToWrite>> made) { take(std::move(made)); },
      [this] { said_->setText(tr("Cancelled: the surfaces were not made.")); });
}

void SurfaceDialog::take(Result<std::vector<SurfaceToWrite>> made) {
  if (!made) return said_->setText(QString::fromStdString(made.message()));
  surfaces_ = std::make_shared<const std::vector<SurfaceToWrite>>(std::move(*made));
  said_->clear();
  fillTable();
}

void SurfaceDialog::fillTable() {
  const QStringList heads = surfaceHeads(writing().reducedByMm > 0);
  table_->clear();
  table_->setColumnCount(int(heads.size()));
  table_->setHorizontalHeaderLabels(heads);
  table_->setRowCount(surfaces_ ? int(surfaces_->size()) : 0);
  for (int row = 0; row < table_->rowCount(); ++row) {
    int column = 0;
    for (const QString& cell : surfaceCells((*surfaces_)[std::size_t(row)])) {
      auto* item = new QTableWidgetItem(cell);
      if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(row, column++, item);
    }
  }
  table_->resizeColumnsToContents();
  save_->setEnabled(surfaces_ != nullptr);
}

}  // namespace volumen
