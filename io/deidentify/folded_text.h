#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// Says how letters with dots (Ä, Ö, Ü) and similar ones are compared: as AE, OE, UE, or as A, O, U.
enum class Umlauts { spelled, dropped };

/// A text prepared for the search for names: only its letters and digits, in lower case and without accents.
class FoldedText {
 public:
  FoldedText(const QString& text, Umlauts umlauts);

  const QString& letters() const { return letters_; }
  /// Returns true if a word can begin or end before letter `n`. A change between letters and digits is such
  /// a boundary. So are both sides of an ideograph (isIdeographic()).
  bool isBoundary(qsizetype n) const { return boundaries_[std::size_t(n)]; }

 private:
  void add(QChar letter);

  QString letters_;
  std::vector<bool> boundaries_;  // one before each letter and one at the end
  bool isApart_ = true;           // the next letter begins a word
};

/// Returns true for characters of Chinese and Japanese, which have no blanks between words, and of Korean,
/// which joins words to names.
bool isIdeographic(QChar c);

}  // namespace volumen
