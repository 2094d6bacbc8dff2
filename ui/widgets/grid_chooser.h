#pragma once

#include <QLabel>
#include <QWidget>
#include <vector>

class QToolButton;

namespace volumen {

/// A field of cells to choose how many rows and columns a grid has: dragged or moved over, a click or the
/// release of the button chooses; with the keyboard, arrows and Enter.
class GridChooser : public QWidget {
  Q_OBJECT
 public:
  /// `nameOf`: what is said of a choice, also to screen readers: "2 rows, 3 columns".
  GridChooser(int rows, int columns, QString (*nameOf)(int rows, int columns), QWidget* parent = nullptr);

  /// Lights the cells of a grid; 0: none.
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
