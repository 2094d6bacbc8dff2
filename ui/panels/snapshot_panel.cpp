#include "ui/panels/snapshot_panel.h"

#include <QGridLayout>
#include <QSignalBlocker>

#include "results/text/text.h"
#include "ui/widgets/colour_button.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

constexpr int largestEdge = 16384;  // pixels

enum BackgroundChoice { asInView, black, white, otherColour, transparent };

}  // namespace

SnapshotPanel::SnapshotPanel(QWidget* parent)
    : QWidget(parent),
      width_(wholeField({QStringLiteral("snapshotWidth"), tr("Width")}, 1, largestEdge, tr(" px"))),
      height_(wholeField({QStringLiteral("snapshotHeight"), tr("Height")}, 1, largestEdge, tr(" px"))),
      pictures_(wholeField({QStringLiteral("turntablePictures"), tr("Pictures of the turntable")}, 2, 999,
                           tr(" pictures"))),
      quality_(choiceField({QStringLiteral("snapshotQuality"), tr("Quality")},
                           {tr("Standard quality"), tr("High quality"), tr("Exact")})),
      format_(choiceField({QStringLiteral("snapshotFormat"), tr("File format")},
                          {QStringLiteral("PNG"), QStringLiteral("JPEG")})),
      background_(
          choiceField({QStringLiteral("snapshotBackground"), tr("Background")},
                      {tr("Background as in the view"), tr("Black background"), tr("White background"),
                       tr("Background of a colour"), tr("Transparent background (PNG)")})),
      colour_(new ColourButton(tr("Background colour"))) {
  quality_->setCurrentIndex(1);
  pictures_->setValue(36);
  colour_->setObjectName(QStringLiteral("snapshotColour"));
  colour_->setColour({0.5, 0.5, 0.5});
  colour_->hide();
  for (QSpinBox* edge : {width_, height_})
    connect(edge, &QSpinBox::valueChanged, this, [this] { sizeChosen_ = true; });
  connect(background_, &QComboBox::currentIndexChanged, this, [this](int choice) {
    colour_->setVisible(choice == otherColour);
    if (choice == transparent) format_->setCurrentIndex(0);
    format_->setEnabled(choice != transparent);
  });
  const auto button = [](const char* name, const QString& text, const QString& label, const auto& clicked) {
    auto* made = buttonOf<QPushButton>(QLatin1String(name), text, clicked);
    made->setAccessibleName(label);
    return made;
  };
  auto* match = button("snapshotMatch", tr("Match view size"), tr("Match view size"), [this] {
    sizeChosen_ = false;
    setViewSize(viewSize_);
  });
  auto* save =
      button("snapshotSave", tr("Save..."), tr("Save the snapshot"), [this] { Q_EMIT saveWanted(); });
  auto* copyIt = button("snapshotCopy", tr("Copy"), tr("Copy the snapshot"), [this] { Q_EMIT copyWanted(); });
  auto* turntable = button("turntableSave", tr("Save turntable..."), tr("Save the turntable"),
                           [this] { Q_EMIT turntableWanted(); });
  turntable->setToolTip(tr("Pictures of a full turn about the view's vertical, into a folder"));
  stack(this,
        {lineOf({{width_, 1}, QStringLiteral("x"), {height_, 1}}),
         match,
         lineOf({{quality_, 1}, format_}),
         lineOf({{background_, 1}, colour_}),
         annotations(),
         lineOf({{save, 1}, {copyIt, 1}}),
         lineOf({{pictures_, 1}, {turntable, 1}}),
         {}},
        8);
  setViewSize(viewSize_);
}

QLayout* SnapshotPanel::annotations() {
  letters_ = flagField({QStringLiteral("snapshotLetters"), tr("Orientation"),
                        tr("Letters of the patient's sides at the edges")});
  scaleBar_ = flagField({QStringLiteral("snapshotScaleBar"), tr("Scale bar"),
                         tr("A length in mm or cm; in parallel projection only")});
  patient_ = flagField(
      {QStringLiteral("snapshotPatient"), tr("Patient and series"), tr("Name, ID and series, top left")});
  warnings_ = flagField(
      {QStringLiteral("snapshotWarnings"), tr("Warnings"),
       tr("What is not as it seems, such as interpolated slices; it always stands in the file's text")});
  warnings_->setChecked(true);
  auto* grid = new QGridLayout;
  grid->addWidget(letters_, 0, 0);
  grid->addWidget(scaleBar_, 0, 1);
  grid->addWidget(patient_, 1, 0);
  grid->addWidget(warnings_, 1, 1);
  return grid;
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
