#include "ui/panels/accuracy_panel.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "results/plots/picture_image.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

enum { levelColumn, msColumn, mostColumn, largestColumn, columns };

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
      showError_(
          flagField({QStringLiteral("showErrorBox"), tr("Show error map"),
                     tr("Show the estimated error of each pixel instead of the picture (black: none)")})),
      difference_(plainLabel()),
      caption_(wrappedLabel(QStringLiteral("differenceCaption"))),
      state_(plainLabel()),
      estimate_(wrappedLabel(QStringLiteral("estimate"))) {
  makeTable();
  difference_->setObjectName(QStringLiteral("difference"));
  difference_->setAccessibleName(tr("Difference from the reference"));
  difference_->setAlignment(Qt::AlignCenter);
  state_->setObjectName(QStringLiteral("measuringState"));
  estimate_->setAccessibleName(tr("Estimated error of the displayed picture"));
  estimate_->setToolTip(tr("How far the displayed picture may be off, estimated while it was drawn"));
  connect(showError_, &QCheckBox::toggled, this, &AccuracyPanel::errorWanted);
  // Always two lines, so that nothing below moves from picture to picture.
  estimate_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  estimate_->setMinimumHeight(2 * estimate_->fontMetrics().lineSpacing());
  auto* aims = new QGridLayout;
  aims->setSpacing(4);
  addAim(*aims, Aim::time, &QualityGoal::frameMs,
         {QStringLiteral("Time"), tr("Keep frames under"),
          tr("Use the most accurate level that is fast enough")},
         tr("Keep frames under a time"), {.low = 1, .high = 100000, .decimals = 0, .suffix = tr(" ms")}, 10);
  addAim(*aims, Aim::error, &QualityGoal::errorOf255,
         {QStringLiteral("Error"), tr("Keep the error under"),
          tr("Use the fastest level with 99 % of the pixels this close to the reference")},
         tr("Keep the error under a limit"), {.low = 0.01, .high = 255, .suffix = tr("/255")}, 0.1);
  stack(this, {sliderRow(), estimate_, showError_, table_, state_, aims, difference_, caption_, {}}, 8);
  showLevel(session_.goal().level);
  showMeasured({});
}

void AccuracyPanel::makeTable() {
  table_->setObjectName(QStringLiteral("levelTable"));
  table_->setAccessibleName(tr("Levels with their times and errors"));
  table_->setHeaderLabels({tr("Level"), tr("Time"), tr("99 % of\npixels within"), tr("Largest\nerror")});
  table_->headerItem()->setToolTip(msColumn, tr("Median time of a full picture in this window"));
  table_->headerItem()->setToolTip(mostColumn,
                                   tr("99 % of the pixels differ from the reference by no more than this"));
  table_->headerItem()->setToolTip(largestColumn, tr("The largest difference from the reference"));
  table_->setRootIsDecorated(false);
  table_->setUniformRowHeights(true);
  table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  for (const PictureLevel level : pictureLevels()) {
    auto* item = new QTreeWidgetItem(table_, {nameOf(level)});
    for (int c = msColumn; c < columns; ++c) {
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
  return lineOf({tr("Faster"), {slider_, 1}, tr("More accurate")}, 8);
}

void AccuracyPanel::addAim(QGridLayout& grid, Aim aim, double QualityGoal::*limit, const FieldText& text,
                           const QString& name, const NumberFormat& format, double step) {
  const Source<QualityGoal> goal{
      .edit = [this](const QString& what, const auto& change) { editGoal(what, change); },
      .done = [this] { session_.endGesture(); },
      .follow =
          [this](QObject* owner, const Follower<QualityGoal>& show) {
            show(session_.goal());
            connect(&session_, &Session::changed, owner,
                    [show](const SessionState&, const SessionState& after) { show(after.goal); });
          }};
  auto* box = flagField({QStringLiteral("meet") + text.name, text.label, text.tip});
  auto* field = numberField({QStringLiteral("aim") + text.name, name, text.tip}, format);
  box->setAccessibleName(name);
  field->setButtonSymbols(QAbstractSpinBox::UpDownArrows);
  field->setSingleStep(step);
  const int row = grid.count() / 2;
  grid.addWidget(goal.bind(box, name,
                           Lens<QualityGoal, bool>{[aim](const QualityGoal& g) { return g.aim == aim; },
                                                   [this, aim](QualityGoal& g, bool on) {
                                                     g.aim = on ? aim : Aim::level;
                                                     g.level = level_;
                                                   }}),
                 row, 0);
  grid.addWidget(goal.bind(field, name,
                           Lens<QualityGoal, double>{[limit](const QualityGoal& g) { return g.*limit; },
                                                     [this, aim, limit](QualityGoal& g, double value) {
                                                       g.aim = aim;
                                                       g.level = level_;
                                                       g.*limit = value;
                                                     }}),
                 row, 1);
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
  item->setText(msColumn, level.ms ? msText(*level.ms) : QStringLiteral("-"));
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
