#pragma once

#include <QFrame>
#include <QPointer>
#include <vector>

class QLineEdit;
class QTreeWidget;

namespace volumen {

/// A field over a window, and rows below it: typing asks for other rows, Up and Down go through those that
/// can be chosen, Enter or a click chooses, Esc or the focus going elsewhere closes. The keys go back to
/// where they were before a row is chosen.
class CommandList : public QFrame {
  Q_OBJECT
 public:
  struct Row {
    QString text;
    QString path;  ///< where else it is found: "View > Layout"
    QString keys;
    bool canBeChosen = true;
  };

  explicit CommandList(QWidget* window);
  /// In this window, empty, with the keys; typed() asks for the first rows.
  void openIn(QWidget* window);
  void setRows(const std::vector<Row>& rows);

 Q_SIGNALS:
  void typed(const QString& text);
  /// By its place among the rows.
  void chosen(int row);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool pressKey(int key);
  void go(int step);
  void choose(int row);
  void leave();

  QLineEdit* search_;
  QTreeWidget* list_;
  QPointer<QWidget> before_;  // had the keys
};

}  // namespace volumen
