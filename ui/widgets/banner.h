#pragma once

#include <QFrame>
#include <QLabel>
#include <QPlainTextEdit>
#include <QToolButton>
#include <functional>

namespace volumen {

/// A sentence over the view, with all its details on demand; stays until it is closed or replaced.
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
  /// How what is told is written, such as without the paths in it. Asked whenever it is told, and by
  /// refresh().
  void setWriting(std::function<QString(const QString&)> writing) { writing_ = std::move(writing); }
  void refresh();

 Q_SIGNALS:
  /// The button of offer() was pressed.
  void accepted();

 private:
  std::function<QString(const QString&)> writing_ = [](const QString& told) { return told; };
  QString told_;
  QStringList toldDetails_;
  QLabel* sentence_;
  QPlainTextEdit* details_;
  QToolButton *more_, *offer_;
};

}  // namespace volumen
