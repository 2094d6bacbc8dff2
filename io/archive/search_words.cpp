#include "io/archive/search_words.h"

#include <QDate>
#include <QRegularExpression>
#include <QString>
#include <algorithm>
#include <optional>
#include <sstream>

#include "io/index/fold.h"
#include "io/index/named_day.h"

namespace volumen {

namespace {

// Modalities of series that users search for (PS3.3 C.7.3.1.1.1).
constexpr const char* knownModalities[] = {
    "AU",  "BI",  "BMD", "CR", "CT",     "CTPROTOCOL", "DOC",    "DX",       "ECG",      "EPS",
    "ES",  "GM",  "HD",  "IO", "IVUS",   "KO",         "LS",     "M3D",      "MG",       "MR",
    "NM",  "OAM", "OCT", "OP", "OPT",    "OPV",        "OT",     "PLAN",     "PR",       "PT",
    "PX",  "REG", "RF",  "RG", "RTDOSE", "RTIMAGE",    "RTPLAN", "RTRECORD", "RTSTRUCT", "SC",
    "SEG", "SM",  "SMR", "SR", "TG",     "US",         "VL",     "XA",       "XC"};

std::string dicomDate(const QDate& date) { return date.toString(QStringLiteral("yyyyMMdd")).toStdString(); }

std::optional<DateRange> daysOf(const QDate& first, const QDate& last) {
  const auto isUsual = [](const QDate& d) { return d.isValid() && d.year() >= 1890 && d.year() <= 2100; };
  if (!isUsual(first) || !isUsual(last)) return {};
  return DateRange{dicomDate(first), dicomDate(last)};
}

QDate dateOf(const QString& text, const char* format) {
  return QDate::fromString(text, QLatin1String(format));
}

std::optional<DateRange> dateRangeOf(const QString& word, const QDate& now) {
  if (const QDate day = namedDay(word, now); day.isValid()) return daysOf(day, day);
  for (const char* format : {"yyyy-MM-dd", "yyyyMMdd", "d.M.yyyy"})
    if (const QDate day = dateOf(word, format); day.isValid()) return daysOf(day, day);
  if (const QDate first = dateOf(word, "yyyy-MM"); first.isValid())
    return daysOf(first, first.addMonths(1).addDays(-1));
  if (const QDate first = dateOf(word, "yyyy"); first.isValid())
    return daysOf(first, first.addYears(1).addDays(-1));
  if (word.size() != 17 || word[8] != QLatin1Char('-')) return {};
  return daysOf(dateOf(word.left(8), "yyyyMMdd"), dateOf(word.mid(9), "yyyyMMdd"));
}

std::string lower(const std::string& utf8) { return QString::fromStdString(utf8).toLower().toStdString(); }
std::string upper(const std::string& utf8) { return QString::fromStdString(utf8).toUpper().toStdString(); }

// Returns the text with a capital at the beginning of each part of a name.
std::string capitalised(const std::string& utf8) {
  QString text = QString::fromStdString(utf8).toLower();
  for (qsizetype n = 0; n < text.size(); ++n)
    if (n == 0 || !text[n - 1].isLetterOrNumber()) text[n] = text[n].toUpper();
  return text.toStdString();
}

// Replaces what is not ASCII, and backslashes, which separate values, by wildcards.
std::string asciiPattern(const std::string& utf8) {
  std::string out;
  for (const char c : utf8) {
    const bool plain = static_cast<unsigned char>(c) < 128 && c != '\\' && c >= ' ';
    if (plain || out.empty() || out.back() != '*') out += plain ? c : '*';
  }
  return out;
}

std::string part(const std::string& text) {
  const std::string pattern = "*" + text + "*";
  return std::ranges::all_of(pattern, [](char c) { return c == '*'; }) ? "" : pattern;
}

// Returns a text in the ways in which an archive may hold it, without repetition.
std::vector<std::string> waysToWrite(const std::string& text) {
  std::vector<std::string> ways;
  const auto add = [&](const std::string& way) {
    if (way.find('\\') == std::string::npos && std::ranges::find(ways, way) == ways.end())
      ways.push_back(way);
  };
  for (const std::string& way : {text, upper(text), capitalised(text), lower(text)})
    add(way), add(asciiPattern(way));
  return ways;
}

// Returns whether a text holds one part of a word, with its wildcards.
bool holdsPart(const std::string& text, const std::string& part) {
  if (part.find_first_of("*?") == std::string::npos) return text.find(part) != std::string::npos;
  QString pattern;
  for (const QChar c : QString::fromStdString(part))
    pattern += c == QLatin1Char('*')   ? QStringLiteral(".*")
               : c == QLatin1Char('?') ? QStringLiteral(".")
                                       : QRegularExpression::escape(QString(c));
  return QRegularExpression(pattern).match(QString::fromStdString(text)).hasMatch();
}

// Returns whether one of the texts holds a word; "müller^erika" has two parts.
bool hold(const std::vector<std::string>& texts, const std::string& word) {
  const std::vector<std::string> parts = foldedWords(word);
  return std::ranges::any_of(texts, [&](const std::string& text) {
    return std::ranges::all_of(parts, [&](const std::string& part) { return holdsPart(text, part); });
  });
}

// Returns the longest part of "müller^erika" or "Smith,": archives keep names with other separators.
std::string longestPart(const std::string& text) {
  std::string parts = text, longest;
  std::ranges::replace_if(
      parts, [](char c) { return c == '^' || c == '=' || c == ','; }, ' ');
  std::istringstream all(parts);
  for (std::string one; all >> one;)
    if (one.size() > longest.size()) longest = one;
  return longest;
}

bool hasModality(const IndexedStudy& study, const std::string& modality) {
  std::istringstream all(study.modalities);
  for (std::string one; std::getline(all >> std::ws, one, ',');)
    if (one == modality) return true;
  return false;
}

}  // namespace

std::vector<SearchWord> searchWords(const std::string& words, const std::string& now) {
  std::vector<SearchWord> out;
  const QDate today = dateOf(QString::fromStdString(now), "yyyyMMdd");
  std::istringstream all(words);
  for (std::string typed; all >> typed;) {
    const QString word = QString::fromStdString(typed).normalized(QString::NormalizationForm_C);
    SearchWord one;
    one.dates = dateRangeOf(word, today);
    if (!namedDay(word, today).isValid()) one.text = word.toStdString();
    const std::string capitals = upper(typed);
    if (std::ranges::find(knownModalities, capitals) != std::end(knownModalities)) one.modality = capitals;
    out.push_back(std::move(one));
  }
  return out;
}

bool hasAll(const std::vector<SearchWord>& words, const IndexedStudy& s) {
  std::vector<std::string> texts{s.patientName, s.patientId, s.accessionNumber, s.description};
  for (std::string& text : texts) text = folded(text);
  return std::ranges::all_of(words, [&](const SearchWord& word) {
    return (!word.modality.empty() && hasModality(s, word.modality)) ||
           (word.dates && word.dates->first <= s.date && s.date <= word.dates->last) ||
           (!word.text.empty() && hold(texts, word.text));
  });
}

std::vector<StudyKeys> questionsFor(const std::vector<SearchWord>& words) {
  if (words.empty()) return {StudyKeys()};
  // A date has fewer answers than a modality, and a long text has the fewest.
  const SearchWord& word = *std::ranges::max_element(words, {}, [](const SearchWord& w) {
    return w.dates ? std::size_t(3) : w.modality.empty() ? 4 + longestPart(w.text).size() : std::size_t(0);
  });
  std::vector<StudyKeys> questions;
  const auto ask = [&](std::string StudyKeys::*key, const std::string& value) {
    StudyKeys keys;
    keys.*key = value;
    if (std::ranges::find(questions, keys) == questions.end()) questions.push_back(keys);
  };
  if (!word.modality.empty()) ask(&StudyKeys::modality, word.modality);
  if (word.dates)
    ask(&StudyKeys::dates, word.dates->first == word.dates->last
                               ? word.dates->first
                               : word.dates->first + "-" + word.dates->last);
  if (word.text.empty()) return questions;
  const std::string text = longestPart(word.text);
  const std::vector<std::string> ways = waysToWrite(text);
  for (const std::string& way : ways) ask(&StudyKeys::patientName, part(way));
  for (const std::string& way : ways) ask(&StudyKeys::description, part(way));
  // Identifiers are short codes.
  for (const std::string& way : ways)
    if (asciiPattern(way) == way)
      ask(&StudyKeys::patientId, part(way)), ask(&StudyKeys::accessionNumber, part(way));
  if (const auto all = std::ranges::find(questions, StudyKeys()); all != questions.end())
    std::rotate(all, all + 1, questions.end());
  return questions;
}

}  // namespace volumen
