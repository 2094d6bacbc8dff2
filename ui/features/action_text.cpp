#include "ui/features/action_text.h"

#include <QAction>
#include <QStringList>

namespace volumen {

QString textOf(const QAction& action) {
  QString text = action.text().section(QLatin1Char('\t'), 0, 0);
  text.replace(QStringLiteral("&&"), QStringLiteral("\t"));  // protects a literal ampersand
  return text.remove(QLatin1Char('&')).replace(QLatin1Char('\t'), QLatin1Char('&'));
}

QString keysOf(const QAction& action) {
  QStringList keys;
  for (const QKeySequence& key : action.shortcuts()) keys << key.toString(QKeySequence::NativeText);
  keys << action.text().section(QLatin1Char('\t'), 1);
  keys.removeAll(QString());
  return keys.join(QStringLiteral(", "));
}

QString tipOf(const QAction& action) {
  const QString keys = keysOf(action);
  return keys.isEmpty() ? textOf(action) : QStringLiteral("%1 (%2)").arg(textOf(action), keys);
}

}  // namespace volumen
