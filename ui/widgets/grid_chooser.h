#pragma once

#include <QLabel>
#include <QWidget>
#include <vector>

class QToolButton;

namespace volumen {

/// Cells to choose rows and columns of a grid. Hovering or dragging highlights a grid; a click or release
/// chooses it. Arrows and Enter do the same.
class GridChooser : public QWidget {
  Q_OBJECT
 public:
  /// `nameOf` returns the text of a choice, also for screen readers: "2 rows, 3 columns".
  GridChooser(int rows, int columns, QString (*nameOf)(int rows, int columns), QWidget* parent = nullptr);

  /// Highlights the cells of a grid; 0: none.
  void light(int rows, int columns);

 Q_SIGNALS:
  void chosen(int rows, int columns);

 protected:
  bool eventFilter(QObject* cell, QEvent* event) override;

 private:
  int numberOf(const QObject* cell) const;
  int numberAt(QPoint global) const;
  void lightTo(int number);
  void choose(int number);
  bool step(int number, int key);

  const int columns_;
  QString (*const nameOf_)(int, int);
  std::vector<QToolButton*> cells_;  // row by row
  QLabel* said_;
};

}  // namespace volumen
