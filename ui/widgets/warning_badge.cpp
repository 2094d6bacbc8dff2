#include "ui/widgets/warning_badge.h"

#include "ui/widgets/plain_text.h"

namespace volumen {

WarningBadge::WarningBadge(QWidget* parent) : QLabel(parent) {
  setObjectName(QStringLiteral("warningBadge"));
  setTextFormat(Qt::PlainText);
  // Independent of the theme, because it lies on the picture.
  setStyleSheet(
      QStringLiteral("#warningBadge { color: #ffc85a; background: rgba(27,30,34,210);"
                     " border: 1px solid #c98a2b; border-radius: 3px; padding: 2px 6px; }"));
  hide();
}

void WarningBadge::tell(const QStringList& words, const QStringList& sentences) {
  QStringList lines;
  for (const QString& word : words) lines << QStringLiteral("! ") + word;
  setText(lines.join(QLatin1Char('\n')));
  setToolTip(toolTipOf(sentences));
  setAccessibleName(tr("Warnings"));
  setAccessibleDescription(sentences.join(QLatin1Char(' ')));
  adjustSize();
  setVisible(!words.isEmpty());
}

}  // namespace volumen
