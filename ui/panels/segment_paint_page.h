#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QToolButton>
#include <QWidget>

#include "ui/controller/segment_editing.h"

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
  void makeLayout();
  QHBoxLayout* lastRow();
  void connectFields();
  void showBrush();
  void showOther();
  void showOthers();
  void fillBetween();

  SegmentEditing& editing_;
  Session& session_;
  QCheckBox* erases_;
  QComboBox* shape_;
  QDoubleSpinBox* mm_;
  QCheckBox* inRange_;
  QComboBox *beside_, *other_;
  QDoubleSpinBox* cutMm_;
  QToolButton* fill_;
};

}  // namespace volumen
