#pragma once

#include <QTreeWidget>

namespace volumen {

/// The tree of the segment list. Takes no more height than it needs. A click on the check box of a row
/// toggles it without selecting the row.
class SegmentTree : public QTreeWidget {
  Q_OBJECT
 public:
  QSize sizeHint() const override { return {QTreeWidget::sizeHint().width(), minimumHeight()}; }

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  QModelIndex boxAt(const QMouseEvent& event) const;

  QPersistentModelIndex pressed_;  // the row whose check box is pressed
};

}  // namespace volumen
