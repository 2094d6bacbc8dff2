#pragma once

#include <QLabel>

namespace volumen {

/// A small sign on the picture that says in a few words what is not as it seems, and in sentences where the
/// cursor is over it. Hidden where there is nothing to say.
class WarningBadge : public QLabel {
  Q_OBJECT
 public:
  explicit WarningBadge(QWidget* parent = nullptr);

  /// `words`: shown, one a line; `sentences`: in the tooltip.
  void tell(const QStringList& words, const QStringList& sentences);
};

}  // namespace volumen
