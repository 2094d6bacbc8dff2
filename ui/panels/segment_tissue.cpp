#include "ui/panels/segment_tissue.h"

#include <QSignalBlocker>

#include "ui/controller/segment_target.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

SegmentTissue::SegmentTissue(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      where_(choiceField({QStringLiteral("segmentTissue"), tr("Where the volume is shown in 3D")},
                         {tr("all of it"), tr("inside segments"), tr("without segments")}, 6)),
      margin_(numberField(
          {QStringLiteral("segmentTissueMargin"), tr("Margin of the segments")},
          {.low = 0, .high = mostTissueMarginMm, .decimals = 1, .suffix = tr(" mm"), .prefix = tr("+ ")})) {
  auto* row = lineOf({tr("Volume in 3D"), {where_, 1}, margin_});
  row->setContentsMargins(0, 0, 0, 0);
  setLayout(row);
  connect(where_, &QComboBox::activated, this, [this](int n) {
    const QString texts[] = {tr("All of the volume in 3D"), tr("Volume only inside segments"),
                             tr("Volume without segments")};
    session_.endGesture();
    change(texts[n], {TissueShown::Where(n), margin_->value()}, {});
  });
  connect(margin_, &QDoubleSpinBox::valueChanged, this, [this](double mm) {
    const QString text = tr("Margin of segments");
    change(text, {TissueShown::Where(where_->currentIndex()), mm}, text);
  });
  connect(margin_, &QDoubleSpinBox::editingFinished, this, [this] { session_.endGesture(); });
  showSegments();
}

void SegmentTissue::change(const QString& text, const TissueShown& tissue, const QString& mergeKey) {
  session_.change(text, withTissueShown(session_.workspace(), keyOf(session_.series()->series), tissue),
                  mergeKey);
}

void SegmentTissue::showSegments() {
  const SegmentMap* map = segmentsShown(session_);
  const TissueShown tissue = map ? map->tissue : TissueShown{};
  const QString why =
      !map && whyNoSegments(session_).isEmpty() ? tr("There is no segment yet.") : whyNoSegments(session_);
  where_->setEnabled(map != nullptr);
  where_->setCurrentIndex(int(tissue.where));
  where_->setToolTip(toolTipOf(
      map ? tr("Where 3D views show the volume itself: all of it, or only what is inside or outside of "
               "the segments that are shown. What lies in a segment that "
               "is drawn opaque is behind its surface: make it translucent, or take "
               "segments out of 3D by In 3D.")
          : why));
  const bool isGrown = map && tissue.where != TissueShown::Where::everywhere;
  const QSignalBlocker quiet(margin_);
  margin_->setEnabled(isGrown);
  margin_->setValue(tissue.marginMm);
  margin_->setToolTip(toolTipOf(isGrown ? tr("The segments are grown by it, in mm of the patient.")
                                : map   ? tr("All of the volume is shown.")
                                        : why));
}

}  // namespace volumen
