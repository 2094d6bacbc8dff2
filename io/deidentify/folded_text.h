#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// How letters with dots (Ä, Ö, Ü) and their like are compared: as AE, OE, UE, or as A, O, U.
enum class Umlauts { spelled, dropped };

/// A text as names are looked for in it: its letters and digits alone, in lower case and without accents.
class FoldedText {
 public:
  FoldedText(const QString& text, Umlauts umlauts);

  const QString& letters() const { return letters_; }
  /// Returns whether a word can begin or end before letter `n`: letters and digits are different words, and
  /// so are the characters of scripts without blanks.
  bool isBoundary(qsizetype n) const { return boundaries_[std::size_t(n)]; }

 private:
  void add(QChar letter);

  QString letters_;
  std::vector<bool> boundaries_;  // one more than letters
  bool isApart_ = true;           // what comes next begins a word
};

/// Returns whether a character is of a script that has no blanks between words, or (Korean) joins words to
/// names: Chinese, Japanese, Korean.
bool isIdeographic(QChar c);

}  // namespace volumen
