#pragma once

#include <QFrame>
#include <QLabel>
#include <QPlainTextEdit>
#include <QToolButton>
#include <functional>
#include <vector>

namespace volumen {

/// Messages over the lower edge of another widget, with details on demand. Each stays until it is taken back
/// or the banner is closed. The other widget keeps its size.
class Banner : public QFrame {
  Q_OBJECT
 public:
  /// `over` must be in the same window.
  explicit Banner(QWidget* over);

  /// A message. `by` identifies the sender, who may take it back; `ofFocus` marks a message on the focused
  /// view.
  struct Sentence {
    QString text;
    QStringList details{};
    const void* by = nullptr;
    bool ofFocus = false;
  };
  /// Replaces all messages by this one.
  void tell(const Sentence& sentence);
  void tell(const QString& sentence, const QStringList& details = {}) { tell(Sentence{sentence, details}); }
  /// Adds a message below the others of an open banner, as for each of several paths.
  void add(const QString& sentence, const QStringList& details = {});
  /// Removes the messages of this sender.
  void takeBack(const void* by);
  /// Removes messages on the focused view.
  void takeBackOfFocus();
  /// Shows a button that offers an action for the message, until the next message.
  void offer(const QString& text);
  QString sentence() const { return sentence_->text(); }
  /// Sets the function that formats messages, such as hiding paths in them. It is called for each new message
  /// and by refresh().
  void setWriting(std::function<QString(const QString&)> writing) { writing_ = std::move(writing); }
  void refresh();

 Q_SIGNALS:
  /// The button of offer() was pressed.
  void accepted();

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void makeLayout();
  void show(bool withDetails);
  void place();
  void takeBackWhere(const std::function<bool(const Sentence&)>& isOver);

  QWidget* over_;
  std::function<QString(const QString&)> writing_ = [](const QString& told) { return told; };
  std::vector<Sentence> told_;
  QLabel* sentence_;
  QPlainTextEdit* details_;
  QToolButton *more_, *offer_;
};

}  // namespace volumen
