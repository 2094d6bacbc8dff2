#include "ui/panels/snapshot_panel.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QStandardPaths>
#include <QVBoxLayout>

namespace volumen {

namespace {
constexpr int largestEdge = 16384;  // pixels
}

SnapshotPanel::SnapshotPanel(QWidget* parent)
    : QWidget(parent),
      width_(new QSpinBox),
      height_(new QSpinBox),
      quality_(new QComboBox),
      transparent_(new QCheckBox(tr("Transparent background"))),
      name_(QStringLiteral("volumen.png")) {
  for (auto [edge, name, label] : {std::tuple(width_, "snapshotWidth", tr("Width")),
                                   std::tuple(height_, "snapshotHeight", tr("Height"))}) {
    edge->setObjectName(QLatin1String(name));
    edge->setAccessibleName(label);
    edge->setRange(1, largestEdge);
    edge->setSuffix(tr(" px"));
    connect(edge, &QSpinBox::valueChanged, this, [this] { sizeChosen_ = true; });
  }
  quality_->setObjectName(QStringLiteral("snapshotQuality"));
  quality_->setAccessibleName(tr("Quality"));
  quality_->addItems({tr("standard quality"), tr("high quality"), tr("exact")});
  quality_->setCurrentIndex(1);
  transparent_->setObjectName(QStringLiteral("snapshotTransparent"));
  auto* asView = new QPushButton(tr("Size of the view"));
  auto* save = new QPushButton(tr("Save PNG..."));
  save->setObjectName(QStringLiteral("snapshotSave"));
  auto* size = new QHBoxLayout;
  size->addWidget(width_, 1);
  size->addWidget(new QLabel(QStringLiteral("x")));
  size->addWidget(height_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addLayout(size);
  auto* kind = new QHBoxLayout;
  kind->addWidget(quality_, 1);
  kind->addWidget(asView);
  column->addLayout(kind);
  column->addWidget(transparent_);
  column->addWidget(save);
  column->addStretch();
  connect(asView, &QPushButton::clicked, this, [this] {
    sizeChosen_ = false;
    setViewSize(viewSize_);
  });
  connect(save, &QPushButton::clicked, this, &SnapshotPanel::askWhere);
  setViewSize(viewSize_);
}

void SnapshotPanel::setViewSize(QSize pixels) {
  viewSize_ = pixels;
  if (sizeChosen_) return;
  const QSignalBlocker quietWidth(width_), quietHeight(height_);
  width_->setValue(pixels.width());
  height_->setValue(pixels.height());
}

void SnapshotPanel::askWhere() {
  auto* dialog = new QFileDialog(this, tr("Save a picture"), {}, tr("PNG pictures (*.png)"));
  dialog->setObjectName(QStringLiteral("snapshotDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("png"));
  const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  if (QFileInfo(pictures).isDir()) dialog->setDirectory(pictures);
  dialog->selectFile(name_);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
    constexpr Quality levels[] = {Quality::standard, Quality::high, Quality::exact};
    Q_EMIT saveRequested({path,
                          {width_->value(), height_->value()},
                          levels[quality_->currentIndex()],
                          transparent_->isChecked()});
  });
  dialog->open();
}

}  // namespace volumen
