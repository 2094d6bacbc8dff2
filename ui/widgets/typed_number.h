#pragma once

#include <QLineEdit>
#include <optional>

namespace volumen {

/// A field for a number within limits. Enter sets it; what is no such number stays, selected, and a sentence
/// says why. Esc and a press elsewhere give up what was typed.
class TypedNumber : public QLineEdit {
  Q_OBJECT
 public:
  TypedNumber(const char* objectName, const QString& name, QWidget* parent = nullptr);

  /// The number that stands there unless it is being typed, below `least` none; shown to so many decimals, of
  /// which those that are 0 are left out.
  void setNumber(double number, double least, double most, int decimals = 0);
  /// Why what stands there cannot be set; empty: it can.
  QString whyNot() const;

 Q_SIGNALS:
  void typed(double number);
  /// Enter was pressed, and this is why nothing is set.
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
