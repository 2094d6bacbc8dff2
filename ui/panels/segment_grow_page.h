#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>

#include "ui/controller/segment_editing.h"

namespace volumen {

/// Makes segments from small input: a sphere around a lesion, a contour at the level under the pointer, or
/// seeds in several segments.
class SegmentGrowPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentGrowPage(SegmentEditing& editing, QWidget* parent = nullptr);

  /// Updates the page for the present segments and series.
  void showSegments();

 private:
  void makeLayout();

  SegmentEditing& editing_;
  QComboBox* region_;
  QPushButton* grow_;
  QCheckBox* preview_;
};

}  // namespace volumen
