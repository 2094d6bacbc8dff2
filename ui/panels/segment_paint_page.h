#pragma once

#include <QWidget>

#include "ui/controller/segment_editing.h"

class QComboBox;
class QToolButton;

namespace volumen {

/// Paints the current segment in slices: tools, brush and limits. Also cuts it and fills slices between
/// painted ones.
class SegmentPaintPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPaintPage(SegmentEditing& editing, QWidget* parent = nullptr);

  /// Updates the page for the current segment.
  void showSegments();

 private:
  void showOther();
  void showOthers();
  void fillBetween();

  SegmentEditing& editing_;
  Session& session_;
  QComboBox* other_;
  QToolButton* fill_;
};

}  // namespace volumen
