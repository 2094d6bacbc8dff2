#pragma once

#include <QFrame>
#include <QLabel>
#include <QPlainTextEdit>
#include <QToolButton>

namespace volumen {

/// A sentence over the view, with all its details on demand; stays until it is closed or replaced. While names
/// are hidden (hideNames) the paths in it are, too.
class Banner : public QFrame {
  Q_OBJECT
 public:
  explicit Banner(QWidget* parent = nullptr);
  void tell(const QString& sentence, const QStringList& details = {});
  /// The same, below what the banner already says while it is open: each of several paths is complained
  /// about.
  void add(const QString& sentence, const QStringList& details = {});
  /// With a button for something to do about what it says, until it says something else.
  void offer(const QString& text);
  QString sentence() const { return sentence_->text(); }
  /// After names were hidden or shown.
  void refresh();

 Q_SIGNALS:
  /// The button of offer() was pressed.
  void accepted();

 private:
  QString told_;
  QStringList toldDetails_;
  QLabel* sentence_;
  QPlainTextEdit* details_;
  QToolButton *more_, *offer_;
};

}  // namespace volumen
