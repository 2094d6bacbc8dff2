#pragma once

#include <QTableView>

namespace volumen {

/// The first column of a table, in sight however far the table is scrolled sideways: a second view of the
/// same rows over the table's left edge, chosen and sorted by either. The table owns it.
class FrozenColumn : public QTableView {
  Q_OBJECT
 public:
  explicit FrozenColumn(QTableView* table);
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void scrollWithTable();
  void sortWithTable();
  void place();
  void uncover(const QModelIndex& current);

  QTableView* table_;
};

}  // namespace volumen
