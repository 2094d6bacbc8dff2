#include "ui/panels/segment_panel.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLocale>
#include <QVBoxLayout>
#include <cmath>
#include <glm/common.hpp>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"
#include "viewer/scene/curve_edits.h"
#include "viewer/scene/visible_range.h"

namespace volumen {

namespace {

QDoubleSpinBox* valueField(const char* name, const QString& label) {
  auto* field = new QDoubleSpinBox;
  field->setObjectName(QLatin1String(name));
  field->setAccessibleName(label);
  field->setRange(-1e9, 1e9);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setMinimumWidth(80);  // its own would leave room for numbers that nobody types
  return field;
}

QString endText(double value, int decimals) { return QLocale().toString(value, 'f', decimals); }

// "Visible: above -454 HU".
QString spanText(const ValueRange& span, int decimals, const QString& unit) {
  const auto end = [&](double value) {
    return (endText(value, decimals) + QLatin1Char(' ') + unit).trimmed();
  };
  if (std::isinf(span.low) && std::isinf(span.high)) return SegmentPanel::tr("Visible: all values");
  if (std::isinf(span.high)) return SegmentPanel::tr("Visible: above %1").arg(end(span.low));
  if (std::isinf(span.low)) return SegmentPanel::tr("Visible: below %1").arg(end(span.high));
  return SegmentPanel::tr("Visible: %1 to %2").arg(endText(span.low, decimals), end(span.high));
}

QString curvedSentence() {
  return SegmentPanel::tr(
      "Volumes along a curve are not the patient's: segment the series that the curve was drawn in.");
}

}  // namespace

SegmentPanel::SegmentPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      table_(new QCheckBox),
      spans_(new QComboBox),
      low_(valueField("segmentLow", tr("Lowest value"))),
      high_(valueField("segmentHigh", tr("Highest value"))),
      segment_(new QPushButton(tr("Segment"))),
      save_(new QPushButton(tr("Save .seg.nrrd..."))),
      result_(plainLabel()),
      only_(new QCheckBox(tr("Show only the segment"))) {
  table_->setObjectName(QStringLiteral("segmentTable"));
  spans_->setObjectName(QStringLiteral("segmentSpans"));
  spans_->setAccessibleName(tr("Visible value range"));
  segment_->setObjectName(QStringLiteral("segment"));
  save_->setObjectName(QStringLiteral("segmentSave"));
  only_->setObjectName(QStringLiteral("segmentOnly"));
  result_->setObjectName(QStringLiteral("segmentResult"));
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  makeLayout();
  connect(spans_, &QComboBox::activated, this, &SegmentPanel::takeSpan);
  connect(only_, &QCheckBox::clicked, this, &SegmentPanel::showOnly);
  connect(only_, &QCheckBox::toggled, this, &SegmentPanel::tellPreview);
  connect(segment_, &QPushButton::clicked, this, [this] {
    result_->setText(tr("Segmenting..."));
    const SeriesKey series = keyOf(session_.series()->series);
    Q_EMIT segmentRequested(series, wholeVolume(), session_.maskOf(series), segmentOf(range()));
  });
  connect(save_, &QPushButton::clicked, this, &SegmentPanel::askWhere);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) showSegment(), tellPreview();
    // Typed numbers stay where only the table goes.
    if (areOneSeries(before.series, after.series) &&
        before.scene.transferFunction == after.scene.transferFunction)
      return;
    showSpans();
    only_->setChecked(only_->isChecked() && after.scene.transferFunction == alone_);
  });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.segmentMaps != after.segmentMaps) showSegment();
          });
  connect(&session_, &Session::preferencesChanged, this,
          [this](const Preferences& before, const Preferences& after) {
            if (before.petUnit != after.petUnit) showInOtherUnit();
          });
  showSpans();
  showSegment();
}

// What was typed stays what it is.
void SegmentPanel::showInOtherUnit() {
  const ValueRange typed = range();
  showSpans();
  low_->setValue(typed.low * factor_);
  high_->setValue(typed.high * factor_);
  showResult();
}

void SegmentPanel::makeLayout() {
  auto* fields = new QHBoxLayout;
  fields->addWidget(plainLabel(tr("From")));
  fields->addWidget(low_, 1);
  fields->addWidget(plainLabel(tr("to")));
  fields->addWidget(high_, 1);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(only_, 1);
  buttons->addWidget(save_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addWidget(table_, 0, Qt::AlignLeft);
  column->addWidget(spans_);
  column->addLayout(fields);
  column->addWidget(segment_);
  column->addWidget(result_);
  column->addLayout(buttons);
  column->addStretch();
}

void SegmentPanel::setTableAction(QAction* action) {
  const auto show = [this, action] {
    table_->setText(action->text());
    table_->setToolTip(action->toolTip());
    table_->setEnabled(action->isEnabled());
    table_->setChecked(action->isChecked());
  };
  connect(action, &QAction::changed, table_, show);
  connect(table_, &QCheckBox::clicked, action, &QAction::trigger);
  show();
}

ValueRange SegmentPanel::range() const {
  return {std::min(low_->value(), high_->value()) / factor_,
          std::max(low_->value(), high_->value()) / factor_};
}

// Called by its values, in the colour that the curve gives their middle.
Segment SegmentPanel::segmentOf(const ValueRange& range) const {
  const QString name = tr("%1 to %2%3")
                           .arg(range.low * factor_)
                           .arg(range.high * factor_)
                           .arg(unitSuffix(session_.series()->series));
  const glm::dvec3 colour = curveAt(session_.scene().transferFunction, (range.low + range.high) / 2).colour;
  return {.number = 1,
          .label = name.trimmed().toStdString(),
          .colour = glm::u8vec3(glm::round(255.0 * colour)),
          .range = range};
}

void SegmentPanel::showSpans() {
  spans_->clear();
  const LoadedSeriesPtr& series = session_.series();
  setEnabled(series != nullptr);
  if (!series) return;
  segment_->setEnabled(!isCurved());
  segment_->setToolTip(toolTipOf(isCurved() ? curvedSentence() : QString()));
  const QString unit = unitSuffix(series->series);
  for (QDoubleSpinBox* field : {low_, high_}) {
    field->setSuffix(unit);
    field->setDecimals(valueDecimals(*series));
  }
  factor_ = shownScale(series->series).factor;
  for (const ValueRange& span : visibleSpans(session_.scene().transferFunction))
    spans_->addItem(spanText({span.low * factor_, span.high * factor_}, valueDecimals(*series) - 1, unit));
  if (spans_->count() == 0) spans_->addItem(tr("Nothing is visible"));
  // Typed numbers stay; where there are none yet, the first span is offered.
  if (!labels_ && !low_->hasFocus() && !high_->hasFocus()) takeSpan(0);
}

void SegmentPanel::takeSpan(int n) {
  const std::vector<ValueRange> spans = visibleSpans(session_.scene().transferFunction);
  if (n < 0 || n >= int(spans.size())) return;
  const Histogram& histogram = session_.series()->histogram;
  // Rounded inwards to what the fields show: the curve's foot itself is not visible, what is next to it is.
  const double steps = std::pow(10.0, low_->decimals());
  low_->setValue(std::ceil(steps * factor_ * std::max(spans[n].low, histogram.low)) / steps);
  high_->setValue(std::floor(steps * factor_ * std::min(spans[n].high, histogram.high)) / steps);
}

bool SegmentPanel::isCurved() const { return session_.series() && session_.series()->series.curved; }

// Of the series in view; null: it has none that this panel made, or another grid, or lies along a curve,
// where neither its places nor its volume are the patient's.
const SegmentMap* SegmentPanel::map() const {
  if (isCurved()) return nullptr;
  const LoadedSeriesPtr& series = session_.series();
  const SegmentMap* map = series ? segmentMapOf(session_.workspace(), keyOf(series->series)) : nullptr;
  const bool fits = map && map->labels && map->labels->geometry() == series->volume->geometry();
  return fits && !map->segments.empty() && map->segments.front().range ? map : nullptr;
}

// With what is cut away; without a series it is not asked for.
VolumePtr SegmentPanel::wholeVolume() const {
  const LoadedSeriesPtr whole = session_.seriesWith(keyOf(session_.series()->series), {});
  return (whole ? whole : session_.series())->volume;
}

// What was cut away since it was made belongs to it still: it is measured in the whole volume.
void SegmentPanel::showSegment() {
  const SegmentMap* shown = map();
  const auto labels = shown ? shown->labels : nullptr;
  const VolumePtr volume = shown ? wholeVolume() : nullptr;
  if (labels && labels == labels_ && volume == volume_) return showResult();
  labels_ = labels;
  volume_ = volume;
  statistics_.reset();
  save_->setEnabled(shown != nullptr);
  only_->setEnabled(shown != nullptr);
  only_->setChecked(false);
  showResult();
  if (shown) Q_EMIT measureRequested(labels_, shown->segments.front().number, volume_);
}

void SegmentPanel::tellPreview() {
  const SegmentMap* shown = only_->isChecked() ? map() : nullptr;
  if (shown)
    Q_EMIT previewChanged(VolumeRange{session_.series()->volume, *shown->segments[0].range});
  else
    Q_EMIT previewChanged({});
}

void SegmentPanel::showMeasured(const std::shared_ptr<const LabelMap>& labels,
                                const LabelStatistics& statistics) {
  if (labels != labels_) return;
  statistics_ = statistics;
  showResult();
}

void SegmentPanel::showResult() {
  if (!statistics_) return result_->setText(isCurved() ? curvedSentence() : QString());
  const LabelStatistics& s = *statistics_;
  const ValueScale scale = shownScale(session_.series()->series);
  const QString unit = shownText(scale.unit), voxels = QLocale().toString(qlonglong(s.voxels));
  QStringList parts;
  if (s.millilitres) parts << tr("%1 ml").arg(*s.millilitres, 0, 'f', *s.millilitres < 100 ? 2 : 0);
  const int decimals = valueDecimals(*session_.series()) - 1;
  if (s.voxels > 0)
    parts << tr("mean %1 %2").arg(s.mean * scale.factor, 0, 'f', decimals).arg(unit).trimmed();
  const QString text = parts.join(QStringLiteral(", ")) + tr(" (%1 voxels)").arg(voxels);
  result_->setText(s.millilitres ? text.trimmed()
                                 : tr("Not calibrated, no volume in ml: %1").arg(text.trimmed()));
}

void SegmentPanel::showOnly(bool on) {
  if (on) {
    before_ = session_.scene().transferFunction;
    alone_ = restrictedTo(before_, *map()->segments[0].range);
  }
  const TransferFunction& curve = on ? alone_ : before_;
  session_.edit(on ? tr("Show only the segment") : tr("Show all values"),
                [&](Scene& s) { s.transferFunction = curve; });
  only_->setChecked(on);
}

void SegmentPanel::askWhere() {
  auto* dialog = new QFileDialog(this, tr("Save segmentation"), {}, tr("Segmentations (*.seg.nrrd)"));
  dialog->setObjectName(QStringLiteral("segmentDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("seg.nrrd"));
  dialog->selectFile(QStringLiteral("segmentation.seg.nrrd"));
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
    if (const SegmentMap* shown = map()) Q_EMIT saveRequested(*shown, path);
  });
  dialog->open();
}

}  // namespace volumen
