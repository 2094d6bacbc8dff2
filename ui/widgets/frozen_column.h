#pragma once

#include <QTableView>

namespace volumen {

/// The first column of a table, always visible when the table scrolls sideways. It is a second view of the
/// same rows over the table's left edge, and shares selection and sorting. The table owns it.
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
