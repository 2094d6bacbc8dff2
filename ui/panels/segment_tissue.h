#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

#include "ui/workspace/session.h"

namespace volumen {

/// Chooses the tissue that 3D views show: all of it, or tissue at visible segments with a margin.
class SegmentTissue : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentTissue(Session& session, QWidget* parent = nullptr);

  /// Updates the fields for the series in view.
  void showSegments();

 private:
  void change(const QString& text, const TissueShown& tissue, const QString& mergeKey);

  Session& session_;
  QComboBox* where_;
  QDoubleSpinBox* margin_;
};

}  // namespace volumen
