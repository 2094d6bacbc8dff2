#pragma once

#include <QFrame>
#include <QLabel>
#include <QPlainTextEdit>
#include <QToolButton>
#include <functional>
#include <vector>

namespace volumen {

/// Sentences over the views, with all their details on demand. Each stays until it is taken back or the
/// banner is closed. It lies over the lower edge of another widget, which keeps its size.
class Banner : public QFrame {
  Q_OBJECT
 public:
  /// Of the same window as `over`, which it lies over.
  explicit Banner(QWidget* over);

  /// A sentence. `by`: whoever may take it back. `ofFocus`: it is about what is in focus.
  struct Sentence {
    QString text;
    QStringList details{};
    const void* by = nullptr;
    bool ofFocus = false;
  };
  /// Says this alone.
  void tell(const Sentence& sentence);
  void tell(const QString& sentence, const QStringList& details = {}) { tell(Sentence{sentence, details}); }
  /// The same, below what the banner already says while it is open: each of several paths is complained
  /// about.
  void add(const QString& sentence, const QStringList& details = {});
  /// Says no more what was told by this one.
  void takeBack(const void* by);
  /// Likewise what is about the focus.
  void takeBackOfFocus();
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
