#include "ui/panels/snapshot_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "ui/widgets/colour_button.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int largestEdge = 16384;  // pixels

enum BackgroundChoice { asInView, black, white, otherColour, transparent };

template <class Widget>
Widget* named(Widget* widget, const char* name, const QString& label) {
  widget->setObjectName(QLatin1String(name));
  widget->setAccessibleName(label);
  return widget;
}

}  // namespace

SnapshotPanel::SnapshotPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  addSize(column);
  addKind(column);
  addBackground(column);
  addAnnotations(column);
  addButtons(column);
  column->addStretch();
  setViewSize(viewSize_);
}

void SnapshotPanel::addSize(QVBoxLayout* column) {
  width_ = named(new QSpinBox, "snapshotWidth", tr("Width"));
  height_ = named(new QSpinBox, "snapshotHeight", tr("Height"));
  for (QSpinBox* edge : {width_, height_}) {
    edge->setRange(1, largestEdge);
    edge->setSuffix(tr(" px"));
    connect(edge, &QSpinBox::valueChanged, this, [this] { sizeChosen_ = true; });
  }
  auto* match = named(new QPushButton(tr("Match view size")), "snapshotMatch", tr("Match view size"));
  auto* row = new QHBoxLayout;
  row->addWidget(width_, 1);
  row->addWidget(plainLabel(QStringLiteral("x")));
  row->addWidget(height_, 1);
  column->addLayout(row);
  column->addWidget(match);
  connect(match, &QPushButton::clicked, this, [this] {
    sizeChosen_ = false;
    setViewSize(viewSize_);
  });
}

void SnapshotPanel::addKind(QVBoxLayout* column) {
  quality_ = named(new QComboBox, "snapshotQuality", tr("Quality"));
  quality_->addItems({tr("Standard quality"), tr("High quality"), tr("Exact")});
  quality_->setCurrentIndex(1);
  format_ = named(new QComboBox, "snapshotFormat", tr("File format"));
  format_->addItems({QStringLiteral("PNG"), QStringLiteral("JPEG")});
  auto* row = new QHBoxLayout;
  row->addWidget(quality_, 1);
  row->addWidget(format_);
  column->addLayout(row);
}

void SnapshotPanel::addBackground(QVBoxLayout* column) {
  background_ = named(new QComboBox, "snapshotBackground", tr("Background"));
  background_->addItems({tr("Background as in the view"), tr("Black background"), tr("White background"),
                         tr("Background of a colour"), tr("Transparent background (PNG)")});
  colour_ = new ColourButton(tr("Background colour"));
  colour_->setObjectName(QStringLiteral("snapshotColour"));
  colour_->setColour({0.5, 0.5, 0.5});
  colour_->hide();
  connect(background_, &QComboBox::currentIndexChanged, this, [this](int choice) {
    colour_->setVisible(choice == otherColour);
    if (choice == transparent) format_->setCurrentIndex(0);
    format_->setEnabled(choice != transparent);
  });
  auto* row = new QHBoxLayout;
  row->addWidget(background_, 1);
  row->addWidget(colour_);
  column->addLayout(row);
}

void SnapshotPanel::addAnnotations(QVBoxLayout* column) {
  const auto box = [](const char* name, const QString& text, const QString& tip) {
    auto* made = new QCheckBox(text);
    made->setObjectName(QLatin1String(name));
    made->setToolTip(toolTipOf(tip));
    return made;
  };
  letters_ = box("snapshotLetters", tr("Orientation"), tr("Letters of the patient's sides at the edges"));
  scaleBar_ =
      box("snapshotScaleBar", tr("Scale bar"), tr("A length in mm or cm; in parallel projection only"));
  patient_ = box("snapshotPatient", tr("Patient and series"), tr("Name, ID and series, top left"));
  warnings_ = box("snapshotWarnings", tr("Warnings"),
                  tr("What is not as it seems, such as interpolated slices; it always stands in the "
                     "file's text"));
  warnings_->setChecked(true);
  auto* grid = new QGridLayout;
  grid->addWidget(letters_, 0, 0);
  grid->addWidget(scaleBar_, 0, 1);
  grid->addWidget(patient_, 1, 0);
  grid->addWidget(warnings_, 1, 1);
  column->addLayout(grid);
}

void SnapshotPanel::addButtons(QVBoxLayout* column) {
  auto* save = named(new QPushButton(tr("Save...")), "snapshotSave", tr("Save the snapshot"));
  auto* copyIt = named(new QPushButton(tr("Copy")), "snapshotCopy", tr("Copy the snapshot"));
  auto* row = new QHBoxLayout;
  row->addWidget(save, 1);
  row->addWidget(copyIt, 1);
  column->addLayout(row);
  pictures_ = named(new QSpinBox, "turntablePictures", tr("Pictures of the turntable"));
  pictures_->setRange(2, 999);
  pictures_->setValue(36);
  pictures_->setSuffix(tr(" pictures"));
  auto* turntable =
      named(new QPushButton(tr("Save turntable...")), "turntableSave", tr("Save the turntable"));
  turntable->setToolTip(tr("Pictures of a full turn about the view's vertical, into a folder"));
  auto* last = new QHBoxLayout;
  last->addWidget(pictures_, 1);
  last->addWidget(turntable, 1);
  column->addLayout(last);
  connect(save, &QPushButton::clicked, this, &SnapshotPanel::saveWanted);
  connect(copyIt, &QPushButton::clicked, this, &SnapshotPanel::copyWanted);
  connect(turntable, &QPushButton::clicked, this, &SnapshotPanel::turntableWanted);
}

void SnapshotPanel::setViewSize(QSize pixels) {
  viewSize_ = pixels;
  if (sizeChosen_) return;
  const QSignalBlocker quietWidth(width_), quietHeight(height_);
  width_->setValue(pixels.width());
  height_->setValue(pixels.height());
}

QString SnapshotPanel::suffix() const {
  return format_->currentIndex() == 0 ? QStringLiteral("png") : QStringLiteral("jpg");
}

std::optional<Background> SnapshotPanel::background() const {
  switch (background_->currentIndex()) {
    case black:
      return Background{};
    case white:
      return Background{.colour = glm::dvec3(1)};
    case otherColour:
      return Background{.colour = colour_->colour()};
    case transparent:
      return Background{.transparent = true};
    default:
      return {};
  }
}

SnapshotRequest SnapshotPanel::chosen(const SnapshotSeen& seen) const {
  constexpr Quality levels[] = {Quality::standard, Quality::high, Quality::exact};
  return {.seen = seen,
          .size = {width_->value(), height_->value()},
          .quality = levels[quality_->currentIndex()],
          .background = background(),
          .shown = {.letters = letters_->isChecked(),
                    .scaleBar = scaleBar_->isChecked(),
                    .patient = patient_->isChecked(),
                    .warnings = warnings_->isChecked()}};
}

}  // namespace volumen
