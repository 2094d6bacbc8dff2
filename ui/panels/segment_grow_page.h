#pragma once

#include <QWidget>

#include "ui/controller/segment_editing.h"

class QCheckBox;
class QPushButton;

namespace volumen {

/// Makes segments from small input: by tools that need one click or drag, or by growing from seeds.
class SegmentGrowPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentGrowPage(SegmentEditing& editing, QWidget* parent = nullptr);

  /// Updates the page for the present segments and series.
  void showSegments();

 private:
  SegmentEditing& editing_;
  QPushButton* grow_;
  QCheckBox* preview_;
};

}  // namespace volumen
