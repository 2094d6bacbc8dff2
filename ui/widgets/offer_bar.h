#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>

namespace volumen {

/// A message over the view with two answers; it stays until one is given or it is closed.
class OfferBar : public QFrame {
  Q_OBJECT
 public:
  explicit OfferBar(QWidget* parent = nullptr);
  void offer(const QString& sentence, const QString& accept, const QString& refuse);
  QString sentence() const { return sentence_->text(); }

 Q_SIGNALS:
  void accepted();
  void refused();

 private:
  QLabel* sentence_;
  QPushButton *accept_, *refuse_;
};

}  // namespace volumen
