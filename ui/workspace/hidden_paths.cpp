#include "ui/workspace/hidden_paths.h"

#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

#include "results/text/text.h"

namespace volumen {

namespace {

const QString punctuation = QStringLiteral(".,:;)\"'");

// Matches a slash that begins a word.
const QRegularExpression& beginOfPath() {
  static const QRegularExpression begin(QStringLiteral("(?<![^\\s\"'(])/(?=[^\\s])"));
  return begin;
}

QString withoutPunctuation(QString text) {
  while (!text.isEmpty() && punctuation.contains(text.back())) text.chop(1);
  return text;
}

// Returns the length of the path that `text` begins with.
qsizetype pathLength(const QString& text) {
  constexpr int mostWords = 60;
  const qsizetype colon = text.indexOf(QLatin1String(": ")), before = colon < 0 ? text.size() : colon;
  qsizetype length = 0, end = 0;
  for (int words = 0; words < mostWords && end < text.size(); ++words) {
    const qsizetype blank = text.indexOf(QLatin1Char(' '), end + 1);
    end = blank < 0 ? text.size() : blank;
    const QString path = withoutPunctuation(text.left(end));
    if (QFileInfo::exists(path)) length = path.size();
  }
  if (length == 0) return withoutPunctuation(text.left(before)).size();
  // A path that does not exist may continue behind one that does.
  const qsizetype other = text.indexOf(beginOfPath(), 1),
                  limit = other < 0 ? before : std::min(before, other);
  const qsizetype slash = text.left(limit).lastIndexOf(QLatin1Char('/'));
  return slash < length ? length : withoutPunctuation(text.left(limit).trimmed()).size();
}

}  // namespace

QString withoutPaths(const QString& sentences) {
  if (!namesHidden()) return sentences;
  QStringList lines = sentences.split(QLatin1Char('\n'));
  const QString instead = tr("(path hidden)");
  for (QString& line : lines)
    for (qsizetype at = line.indexOf(beginOfPath()); at >= 0;
         at = line.indexOf(beginOfPath(), at + instead.size()))
      line.replace(at, pathLength(line.mid(at)), instead);
  return lines.join(QLatin1Char('\n'));
}

}  // namespace volumen
