#pragma once

#include <QLabel>

namespace volumen {

/// A small sign on the picture with warnings in a few words, such as interpolated slices, and full sentences
/// in its tooltip. Hidden without warnings.
class WarningBadge : public QLabel {
  Q_OBJECT
 public:
  explicit WarningBadge(QWidget* parent = nullptr);

  /// Shows `words`, one a line, and `sentences` in the tooltip.
  void tell(const QStringList& words, const QStringList& sentences);
};

}  // namespace volumen
