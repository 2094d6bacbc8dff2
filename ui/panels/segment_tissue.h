#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

#include "ui/workspace/session.h"

namespace volumen {

/// Where 3D views show the volume itself: all of it, or by the segments that are shown, with a margin.
class SegmentTissue : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentTissue(Session& session, QWidget* parent = nullptr);

  /// Shows what holds for the series in view.
  void showSegments();

 private:
  void makeLayout();
  void change(const QString& text, const TissueShown& tissue, const QString& mergeKey);

  Session& session_;
  QComboBox* where_;
  QDoubleSpinBox* margin_;
};

}  // namespace volumen
