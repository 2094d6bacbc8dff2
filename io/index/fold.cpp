#include "io/index/fold.h"

#include <QString>
#include <QStringList>

namespace volumen {
namespace {

// Letters without a Unicode decomposition that people type without stroke.
QString plainLetter(QChar c) {
  switch (c.unicode()) {
    case 0x00e6:
      return QStringLiteral("ae");
    case 0x0153:
      return QStringLiteral("oe");
    case 0x00df:
      return QStringLiteral("ss");
    case 0x00f8:
      return QStringLiteral("o");
    case 0x0111:
    case 0x00f0:
      return QStringLiteral("d");
    case 0x0142:
      return QStringLiteral("l");
    case 0x0131:
      return QStringLiteral("i");
    case 0x00fe:
      return QStringLiteral("th");
    default:
      return c;
  }
}

bool separates(QChar c) {
  return c == QLatin1Char('^') || c == QLatin1Char('=') || c == QLatin1Char(',') || c.isSpace() ||
         c.category() == QChar::Other_Control;
}

bool isMark(QChar c) {
  return c.category() == QChar::Mark_NonSpacing || c.category() == QChar::Mark_Enclosing;
}

}  // namespace

std::string folded(const std::string& utf8) {
  const QString text = QString::fromStdString(utf8).normalized(QString::NormalizationForm_KD).toCaseFolded();
  QString out;
  out.reserve(text.size());
  for (const QChar c : text) {
    if (isMark(c)) continue;
    if (separates(c))
      out += QLatin1Char(' ');
    else
      out += plainLetter(c);
  }
  return out.simplified().toStdString();
}

std::vector<std::string> foldedWords(const std::string& utf8) {
  std::vector<std::string> words;
  const QString text = QString::fromStdString(folded(utf8));
  for (const QString& word : text.split(QLatin1Char(' '), Qt::SkipEmptyParts))
    words.push_back(word.toStdString());
  return words;
}

std::string likePattern(const std::string& text) {
  std::string pattern = "%";
  for (const char c : text) {
    if (c == '%' || c == '_' || c == '\\') pattern += '\\';
    pattern += c;
  }
  return pattern + "%";
}

}  // namespace volumen
