#include "io/deidentify/folded_text.h"

#include <algorithm>

namespace volumen {

namespace {

// Returns the letters that stand for a letter such as ä; empty if it stands for itself.
QString spellingOf(QChar c, Umlauts umlauts) {
  const bool isSpelled = umlauts == Umlauts::spelled;
  switch (c.unicode()) {
    case u'\u00e4':
      return isSpelled ? QStringLiteral("ae") : QStringLiteral("a");
    case u'\u00f6':
    case u'\u00f8':
      return isSpelled ? QStringLiteral("oe") : QStringLiteral("o");
    case u'\u00fc':
      return isSpelled ? QStringLiteral("ue") : QStringLiteral("u");
    case u'\u00e5':
      return isSpelled ? QStringLiteral("aa") : QStringLiteral("a");
    case u'\u00e6':
      return QStringLiteral("ae");
    case u'\u0153':
      return QStringLiteral("oe");
    case u'\u00df':
      return QStringLiteral("ss");
    default:
      return {};
  }
}

bool isAccent(QChar c) { return c >= u'\u0300' && c <= u'\u036f'; }

// Returns true for letters of the Latin, Greek or Cyrillic script, which are compared without accents.
bool losesAccents(QChar c) { return (c > u'\u007f' && c < u'\u0530') || (c >= u'\u1e00' && c <= u'\u1fff'); }

bool isPartOfWord(QChar c) { return c.isLetterOrNumber() || c.isMark() || c.isSurrogate(); }

}  // namespace

bool isIdeographic(QChar c) {
  return (c >= u'\u2e80' && c <= u'\u9fff') || (c >= u'\uac00' && c <= u'\ud7ff') || c.isSurrogate() ||
         (c >= u'\uf900' && c <= u'\ufaff');
}

FoldedText::FoldedText(const QString& text, Umlauts umlauts) {
  for (const QChar c : text.normalized(QString::NormalizationForm_KC).toCaseFolded()) {
    if (isAccent(c)) continue;
    const QString spelling = spellingOf(c, umlauts);
    if (!spelling.isEmpty())
      std::ranges::for_each(spelling, [&](QChar letter) { add(letter); });
    else if (losesAccents(c))
      add(QString(c).normalized(QString::NormalizationForm_D).front());
    else
      add(c);
  }
  boundaries_.push_back(true);
}

void FoldedText::add(QChar letter) {
  if (!isPartOfWord(letter)) {
    isApart_ = true;
    return;
  }
  const bool isOther = !letters_.isEmpty() && (letters_.back().isDigit() != letter.isDigit() ||
                                               isIdeographic(letters_.back()) || isIdeographic(letter));
  boundaries_.push_back(isApart_ || isOther);
  letters_ += letter;
  isApart_ = false;
}

}  // namespace volumen
