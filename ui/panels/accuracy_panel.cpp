#include "ui/panels/accuracy_panel.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "results/plots/picture_image.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

enum { levelColumn, timeColumn, mostColumn, largestColumn, columns };

constexpr int tallestDifference = 220;  // pixels

int rowOf(PictureLevel level) {
  const auto& all = pictureLevels();
  return int(std::find(all.begin(), all.end(), level) - all.begin());
}

QString nameOf(PictureLevel level) { return QString::fromStdString(levelName(level)); }

QString inDigits(double x) { return QString::number(x, 'f', x < 0.995 ? 2 : x < 9.95 ? 1 : 0); }

QString msText(double ms) {
  return ms < 9950 ? AccuracyPanel::tr("%1 ms").arg(ms, 0, 'f', ms < 9.95 ? 1 : 0)
                   : AccuracyPanel::tr("%1 s").arg(ms / 1000, 0, 'f', 1);
}

QString errorText(double of255) { return AccuracyPanel::tr("%1/255").arg(inDigits(of255)); }

// Returns the estimate as text, or a sentence why there is none.
QString estimateOf(const ScreenPicture& frame) {
  if (frame.factor > 1) return AccuracyPanel::tr("Enlarged from fewer pixels: no error estimate.");
  if (!frame.estimated) return QString::fromStdString(whyNoEstimate(*frame.plan));
  const PictureError& e = *frame.estimated;
  if (isRoundingAlone(e)) return AccuracyPanel::tr("This picture: exact up to floating-point rounding");
  const QString text =
      AccuracyPanel::tr("This picture (estimated): 99 % of pixels within %1, largest error %2, PSNR %3 dB")
          .arg(errorText(e.percentile99), errorText(e.maximum))
          .arg(std::floor(e.psnrDb));
  const std::string without = notEstimated(*frame.plan);
  return without.empty()
             ? text
             : AccuracyPanel::tr("%1; not counting %2").arg(text, QString::fromStdString(without));
}

// Returns a power of two that makes 99 % of the differences visible without clipping them.
double magnificationOf(const PictureError& error) {
  const double most = 255 / std::max(error.percentile99, 1e-3);
  return std::clamp(std::exp2(std::floor(std::log2(most))), 1.0, 4096.0);
}

}  // namespace

AccuracyPanel::AccuracyPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      slider_(new QSlider(Qt::Horizontal)),
      table_(new QTreeWidget),
      meetTime_(new QCheckBox(tr("Keep frames under"))),
      meetError_(new QCheckBox(tr("Keep the error under"))),
      showError_(new QCheckBox(tr("Show error map"))),
      frameMs_(new QDoubleSpinBox),
      error_(new QDoubleSpinBox),
      difference_(plainLabel()),
      caption_(plainLabel()),
      state_(plainLabel()),
      estimate_(plainLabel()) {
  makeTable();
  frameMs_->setRange(1, 100000);
  frameMs_->setDecimals(0);
  frameMs_->setSingleStep(10);
  frameMs_->setSuffix(tr(" ms"));
  error_->setRange(0.01, 255);
  error_->setDecimals(2);
  error_->setSingleStep(0.1);
  error_->setSuffix(tr("/255"));
  meetTime_->setToolTip(tr("Use the most accurate level that is fast enough"));
  meetError_->setToolTip(tr("Use the fastest level with 99 % of the pixels this close to the reference"));
  difference_->setObjectName(QStringLiteral("difference"));
  difference_->setAccessibleName(tr("Difference from the reference"));
  difference_->setAlignment(Qt::AlignCenter);
  caption_->setObjectName(QStringLiteral("differenceCaption"));
  caption_->setWordWrap(true);
  state_->setObjectName(QStringLiteral("measuringState"));
  estimate_->setObjectName(QStringLiteral("estimate"));
  estimate_->setAccessibleName(tr("Estimated error of the displayed picture"));
  estimate_->setToolTip(tr("How far the displayed picture may be off, estimated while it was drawn"));
  estimate_->setWordWrap(true);
  showError_->setObjectName(QStringLiteral("showErrorBox"));
  showError_->setToolTip(tr("Show the estimated error of each pixel instead of the picture (black: none)"));
  connect(showError_, &QCheckBox::toggled, this, &AccuracyPanel::errorWanted);
  // Always two lines, so that nothing below moves from picture to picture.
  estimate_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  estimate_->setMinimumHeight(2 * estimate_->fontMetrics().lineSpacing());
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addLayout(sliderRow());
  column->addWidget(estimate_);
  column->addWidget(showError_);
  column->addWidget(table_);
  column->addWidget(state_);
  auto* aims = new QGridLayout;
  aims->setSpacing(4);
  addAim(*aims, 0, meetTime_, frameMs_, Aim::time, tr("Keep frames under a time"));
  addAim(*aims, 1, meetError_, error_, Aim::error, tr("Keep the error under a limit"));
  column->addLayout(aims);
  column->addWidget(difference_);
  column->addWidget(caption_);
  column->addStretch();
  connect(&session_, &Session::changed, this,
          [this](const SessionState&, const SessionState& after) { showGoal(after.goal); });
  showGoal(session_.goal());
  showLevel(session_.goal().level);
  showMeasured({});
}

void AccuracyPanel::makeTable() {
  table_->setObjectName(QStringLiteral("levelTable"));
  table_->setAccessibleName(tr("Levels with their times and errors"));
  table_->setHeaderLabels({tr("Level"), tr("Time"), tr("99 % of\npixels within"), tr("Largest\nerror")});
  table_->headerItem()->setToolTip(timeColumn, tr("Median time of a full picture in this window"));
  table_->headerItem()->setToolTip(mostColumn,
                                   tr("99 % of the pixels differ from the reference by no more than this"));
  table_->headerItem()->setToolTip(largestColumn, tr("The largest difference from the reference"));
  table_->setRootIsDecorated(false);
  table_->setUniformRowHeights(true);
  table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  for (const PictureLevel level : pictureLevels()) {
    auto* item = new QTreeWidgetItem(table_, {nameOf(level)});
    for (int c = timeColumn; c < columns; ++c) {
      item->setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
      table_->headerItem()->setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
    }
  }
  table_->header()->setStretchLastSection(false);
  table_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->header()->setSectionResizeMode(levelColumn, QHeaderView::Stretch);
  table_->header()->setSectionsMovable(false);
  table_->header()->setMinimumSectionSize(40);
  connect(table_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) choose(table_->indexOfTopLevelItem(item));
  });
}

QLayout* AccuracyPanel::sliderRow() {
  slider_->setObjectName(QStringLiteral("levelSlider"));
  slider_->setAccessibleName(tr("Quality level"));
  slider_->setRange(0, int(pictureLevels().size()) - 1);
  slider_->setPageStep(1);
  connect(slider_, &QSlider::valueChanged, this, [this](int row) {
    choose(row);
    if (!slider_->isSliderDown()) session_.endGesture();
  });
  connect(slider_, &QSlider::sliderReleased, this, [this] { session_.endGesture(); });
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addWidget(plainLabel(tr("Faster")));
  row->addWidget(slider_, 1);
  row->addWidget(plainLabel(tr("More accurate")));
  return row;
}

void AccuracyPanel::addAim(QGridLayout& grid, int row, QCheckBox* box, QDoubleSpinBox* field, Aim aim,
                           const QString& name) {
  const QString suffix = aim == Aim::time ? QStringLiteral("Time") : QStringLiteral("Error");
  box->setObjectName(QStringLiteral("meet") + suffix);
  field->setObjectName(QStringLiteral("aim") + suffix);
  box->setAccessibleName(name);
  field->setAccessibleName(name);
  field->setToolTip(box->toolTip());
  field->setKeyboardTracking(false);
  connect(box, &QCheckBox::clicked, this, [this, name, aim](bool on) {
    editGoal(name, [&](QualityGoal& goal) {
      goal.aim = on ? aim : Aim::level;
      goal.level = level_;
    });
    session_.endGesture();
  });
  connect(field, &QDoubleSpinBox::valueChanged, this, [this, name, aim](double value) {
    editGoal(name, [&](QualityGoal& goal) {
      goal.aim = aim;
      goal.level = level_;
      (aim == Aim::time ? goal.frameMs : goal.errorOf255) = value;
    });
  });
  connect(field, &QDoubleSpinBox::editingFinished, this, [this] { session_.endGesture(); });
  grid.addWidget(box, row, 0);
  grid.addWidget(field, row, 1);
}

void AccuracyPanel::choose(int row) {
  editGoal(tr("Quality level"), [&](QualityGoal& goal) {
    goal.aim = Aim::level;
    goal.level = pictureLevels()[std::size_t(row)];
  });
}

void AccuracyPanel::editGoal(const QString& text, const std::function<void(QualityGoal&)>& change) {
  QualityGoal after = session_.goal();
  change(after);
  session_.setGoal(text, after, text);
}

void AccuracyPanel::showGoal(const QualityGoal& goal) {
  const QSignalBlocker quietTime(frameMs_), quietError(error_);
  meetTime_->setChecked(goal.aim == Aim::time);
  meetError_->setChecked(goal.aim == Aim::error);
  frameMs_->setValue(goal.frameMs);
  error_->setValue(goal.errorOf255);
}

void AccuracyPanel::showLevel(PictureLevel level) {
  level_ = level;
  const QSignalBlocker quietSlider(slider_), quietTable(table_);
  const int row = rowOf(level);
  if (!slider_->isSliderDown()) slider_->setValue(row);
  slider_->setToolTip(toolTipOf(nameOf(level)));
  table_->setCurrentItem(table_->topLevelItem(row));
  showDifference();
}

void AccuracyPanel::showMeasured(const MeasuredLevels& measured) {
  measured_ = measured;
  for (int row = 0; row < table_->topLevelItemCount(); ++row) showRow(row);
  const bool all = !measured.levels.empty() && measured.levels.back().done();
  if (all)
    state_->setText(tr("Measured at %L1 of %L2 pixels")
                        .arg(measured.truth->pixels.size())
                        .arg(qint64(measured.truth->size.x) * measured.truth->size.y));
  else if (measured.levels.empty())
    state_->setText(tr("Measured when the picture is complete"));
  showDifference();
}

void AccuracyPanel::showRow(int row) {
  QTreeWidgetItem* item = table_->topLevelItem(row);
  const bool known = row < int(measured_.levels.size());
  const MeasuredLevel level = known ? measured_.levels[std::size_t(row)] : MeasuredLevel{};
  item->setText(timeColumn, level.ms ? msText(*level.ms) : QStringLiteral("-"));
  const PictureError error = level.ms ? statedError(measured_.levels, std::size_t(row)) : PictureError();
  item->setText(mostColumn, level.ms ? errorText(error.percentile99) : QStringLiteral("-"));
  item->setText(largestColumn, level.ms ? errorText(error.maximum) : QStringLiteral("-"));
  const bool beaten = level.ms && !level.front;
  QString tip = QString::fromStdString(level.failure);
  if (beaten) tip = tr("A more accurate level is faster here.");
  QFont font = table_->font();
  font.setItalic(beaten);
  for (int c = 0; c < columns; ++c) {
    item->setFont(c, font);
    item->setToolTip(c, toolTipOf(tip));
  }
}

void AccuracyPanel::showProgress(const QString& what, double share) {
  state_->setText(tr("Measuring: %1, %2 %").arg(what).arg(std::lround(100 * share)));
}

void AccuracyPanel::showEstimate(const ScreenPicture& frame) { estimate_->setText(estimateOf(frame)); }

void AccuracyPanel::setErrorWanted(bool wanted) { showError_->setChecked(wanted); }

void AccuracyPanel::showDifference() {
  const int row = rowOf(level_);
  const MeasuredLevel* level =
      row < int(measured_.levels.size()) ? &measured_.levels[std::size_t(row)] : nullptr;
  const bool known = level && level->ms && measured_.truth;
  difference_->setVisible(known);
  caption_->setVisible(known);
  if (!known) return;
  const double times = magnificationOf(level->error);
  const QImage image = differenceImage(level->pixels, *measured_.truth, times);
  const QSize room(std::max(16, width() - 16), tallestDifference);
  QPixmap shown = QPixmap::fromImage(image.scaled(room * devicePixelRatioF(), Qt::KeepAspectRatio));
  shown.setDevicePixelRatio(devicePixelRatioF());
  difference_->setPixmap(shown);
  caption_->setText(
      tr("Difference between %1 and the reference, %2 times as bright").arg(nameOf(level_)).arg(times));
}

void AccuracyPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // Shows all rows without a scroll bar.
  const int rows = table_->sizeHintForRow(0) * table_->topLevelItemCount();
  table_->setFixedHeight(rows + table_->header()->sizeHint().height() + 2 * table_->frameWidth());
  showDifference();
}

}  // namespace volumen
