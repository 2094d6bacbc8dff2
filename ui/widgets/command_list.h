#pragma once

#include <QFrame>
#include <QPointer>
#include <vector>

class QLineEdit;
class QTreeWidget;

namespace volumen {

/// A search field with rows below, over a window. Typing requests rows, Up and Down select enabled ones,
/// Enter or a click chooses. Esc or loss of focus closes it. Focus returns to its previous widget before a
/// row is chosen.
class CommandList : public QFrame {
  Q_OBJECT
 public:
  struct Row {
    QString text;
    QString path;  ///< its menu path: "View > Layout"
    QString keys;
    bool canBeChosen = true;
  };

  explicit CommandList(QWidget* window);
  /// Opens an empty list with focus in this window; typed() requests the first rows.
  void openIn(QWidget* window);
  void setRows(const std::vector<Row>& rows);

 Q_SIGNALS:
  void typed(const QString& text);
  /// `row` is the index among the rows.
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
  QPointer<QWidget> before_;  // had focus before
};

}  // namespace volumen
