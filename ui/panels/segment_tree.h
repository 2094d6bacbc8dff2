#pragma once

#include <QTreeWidget>

namespace volumen {

/// The tree of the list of segments. It asks for no more height than it must have, and a click on the box in
/// the first column of a row ticks it without choosing the row.
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

  QPersistentModelIndex pressed_;  // whose box was pressed
};

}  // namespace volumen
