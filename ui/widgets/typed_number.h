#pragma once

#include <QLineEdit>
#include <optional>

namespace volumen {

/// A field for a number within limits. Enter sets it; an invalid text stays, selected, and a message gives
/// the reason. Esc and a press elsewhere discard the text.
class TypedNumber : public QLineEdit {
  Q_OBJECT
 public:
  TypedNumber(const char* objectName, const QString& name, QWidget* parent = nullptr);

  /// Sets the number shown when nobody types; below `least` there is none. It has `decimals` digits without
  /// trailing zeros.
  void setNumber(double number, double least, double most, int decimals = 0);
  /// Returns the reason why the text is invalid; empty if it is valid.
  QString whyNot() const;

 Q_SIGNALS:
  void typed(double number);
  /// Enter was pressed on an invalid text; `sentence` is the reason.
  void refused(const QString& sentence);
  /// Esc was pressed.
  void givenUp();

 protected:
  bool event(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void focusOutEvent(QFocusEvent*) override;

 private:
  QString textOf(double number) const;
  QString stands() const;
  std::optional<double> number() const;

  double number_ = 0, least_ = 0, most_ = 0;
  int decimals_ = 0;
};

}  // namespace volumen
