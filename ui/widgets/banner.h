#pragma once

#include <QFrame>
#include <QLabel>
#include <QToolButton>

namespace volumen {

/// One sentence over the view, with details on demand; stays until it is closed or replaced.
class Banner : public QFrame {
  Q_OBJECT
 public:
  explicit Banner(QWidget* parent = nullptr);
  void tell(const QString& sentence, const QStringList& details = {});
  QString sentence() const { return sentence_->text(); }

 private:
  QLabel *sentence_, *details_;
  QToolButton* more_;
};

}  // namespace volumen
