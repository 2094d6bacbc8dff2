// Guards that the words of a search find a study in an archive: what is asked, and what counts as an answer.
#include <QRegularExpression>
#include <algorithm>

#include "io/archive/search_words.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSearchWords : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void wordsHaveMeanings_data();
  void wordsHaveMeanings();
  void studiesHaveAllWords_data();
  void studiesHaveAllWords();
  void aStudyIsAskedForHoweverItIsTyped();
  void eachMeaningIsAskedFor();
  void noKeyHoldsABackslash();
};

namespace {

IndexedStudy studyOf(const char* name, const char* id, const char* date, const char* modalities,
                     const char* description) {
  IndexedStudy s;
  s.patientName = name, s.patientId = id, s.date = date, s.modalities = modalities;
  s.description = description;
  return s;
}

// Returns whether an archive that compares bytes finds `text` by a key (PS3.4 C.2.2.2.4).
bool matches(const std::string& key, const std::string& text) {
  if (key.empty()) return true;
  const QRegularExpression pattern(
      QRegularExpression::wildcardToRegularExpression(QString::fromStdString(key)));
  return pattern.match(QString::fromStdString(text)).hasMatch();
}

}  // namespace

void TestSearchWords::wordsHaveMeanings_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("modality");
  QTest::addColumn<QString>("dates");
  const auto row = [](const char* word, const char* text, const char* modality, const char* dates) {
    QTest::newRow(word) << QString::fromUtf8(word) << QString::fromUtf8(text) << QString::fromUtf8(modality)
                        << QString::fromUtf8(dates);
  };
  row("Smith", "Smith", "", "");
  row("ct", "ct", "CT", "");
  row("doctor", "doctor", "", "");
  row("u\u0308", "\u00fc", "", "");
  row("today", "", "", "20260301-20260301");
  row("Yesterday", "", "", "20260228-20260228");
  row("2025-12-31", "2025-12-31", "", "20251231-20251231");
  row("20251231", "20251231", "", "20251231-20251231");
  row("31.12.2025", "31.12.2025", "", "20251231-20251231");
  row("2024-02", "2024-02", "", "20240201-20240229");
  row("2024", "2024", "", "20240101-20241231");
  row("20240101-20240630", "20240101-20240630", "", "20240101-20240630");
  row("20251399", "20251399", "", "");
  row("10101010", "10101010", "", "");
  row("1234", "1234", "", "");
}

void TestSearchWords::wordsHaveMeanings() {
  QFETCH(QString, word);
  QFETCH(QString, text);
  QFETCH(QString, modality);
  QFETCH(QString, dates);
  const std::vector<SearchWord> words = searchWords(" " + word.toStdString() + "  x", "20260301");
  QCOMPARE(words.size(), std::size_t(2));
  const SearchWord& one = words[0];
  QCOMPARE(QString::fromStdString(one.text), text);
  QCOMPARE(QString::fromStdString(one.modality), modality);
  QCOMPARE(one.dates ? QString::fromStdString(one.dates->first + "-" + one.dates->last) : QString(), dates);
  QVERIFY(searchWords("  ", "20260301").empty());
}

void TestSearchWords::studiesHaveAllWords_data() {
  QTest::addColumn<QString>("words");
  QTest::addColumn<bool>("expected");
  const auto row = [](const char* words, bool expected) {
    QTest::newRow(words) << QString::fromUtf8(words) << expected;
  };
  row("müller", true);
  row("MULLER", true);
  row("erika müller", true);
  row("müller^erika", true);
  row("m*er", true);
  row("m?ller", true);
  row("meier", false);
  row("müller meier", false);
  row("pid-7", true);
  row("abdomen", true);
  row("ct", true);
  row("seg", true);
  row("mr", false);
  row("2026", true);
  row("2025", false);
  row("müller, erika", true);
  row("nativ", true);
  row("us", false);
  row("2026-03", true);
  row("2026-04", false);
  row("müller ct 14.3.2026", true);
}

void TestSearchWords::studiesHaveAllWords() {
  QFETCH(QString, words);
  QFETCH(bool, expected);
  const IndexedStudy study = studyOf("Müller^Erika", "PID-7", "20260314", "CT, SEG", "Abdomen nativ");
  QCOMPARE(hasAll(searchWords(words.toStdString(), "20260301"), study), expected);
}

// An archive may compare bytes: names in capitals, in small letters, and in other scripts.
void TestSearchWords::aStudyIsAskedForHoweverItIsTyped() {
  const Seeds seeds = seedsOf(500, 5000);
  const char* names[] = {"Buc^Jérôme",   "BUC^JÉRÔME",    "smith^john", "Smith^John", "O'Neill^Anna-Maria",
                         "Люкceмбypг",   "やまだ^たろう", "Διονυσιος",  "김희중",     "قباني^لنزار",
                         "DOE^JANE^^DR", "Äneas^Rüdiger"};
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const IndexedStudy study =
        studyOf(names[chance.below(int(std::size(names)))], "ID1", "20260314", "CT", "Thorax");
    const QString name = QString::fromStdString(study.patientName);
    const int from = chance.below(int(name.size()) - 2);
    QString typed = name.mid(from, 3 + chance.below(8));
    if (typed.trimmed() != typed || typed.contains(QLatin1Char(' '))) continue;
    const bool isCapital = name == name.toUpper(), isSmall = name == name.toLower();
    // The beginnings of words may be capitals in the archive.
    if (isCapital || isSmall || from == 0 || !name[from - 1].isLetterOrNumber())
      typed = chance.oneIn(2) ? typed.toUpper() : typed.toLower();
    const std::vector<SearchWord> words = searchWords(typed.toStdString(), "20260301");
    const std::vector<StudyKeys> asked = questionsFor(words);
    const bool found = std::ranges::any_of(asked, [&](const StudyKeys& k) {
      return matches(k.patientName, study.patientName) && matches(k.patientId, study.patientId) &&
             matches(k.description, study.description) && matches(k.accessionNumber, study.accessionNumber) &&
             k.modality.empty() && k.dates.empty();
    });
    QVERIFY2(found, qPrintable(QStringLiteral("seed %1: %2 as %3").arg(seed).arg(name, typed)));
    QVERIFY2(hasAll(words, study),
             qPrintable(QStringLiteral("seed %1: %2 as %3").arg(seed).arg(name, typed)));
  }
}

// What looks like a modality or a date may be part of a name or a number.
void TestSearchWords::eachMeaningIsAskedFor() {
  const auto asks = [](const char* words, std::string StudyKeys::*key, const char* value) {
    return std::ranges::any_of(questionsFor(searchWords(words, "20260301")),
                               [&](const StudyKeys& k) { return k.*key == value; });
  };
  QVERIFY(asks("au", &StudyKeys::modality, "AU"));
  QVERIFY(asks("au", &StudyKeys::patientName, "*Au*"));
  QVERIFY(asks("20260314", &StudyKeys::dates, "20260314"));
  QVERIFY(asks("20260314", &StudyKeys::patientId, "*20260314*"));
  QVERIFY(asks("li 2025", &StudyKeys::patientName, "*Li*"));
  QVERIFY(asks("ct 2025", &StudyKeys::dates, "20250101-20251231"));
  QVERIFY(asks("Smith, John", &StudyKeys::patientName, "*Smith*"));
  QVERIFY(asks("PID7", &StudyKeys::patientId, "*pid7*"));
  QCOMPARE(questionsFor({}).size(), std::size_t(1));
  const std::vector<StudyKeys> greek = questionsFor(searchWords("Διονυσιος", "20260301"));
  QVERIFY(greek.back() == StudyKeys());
  QCOMPARE(std::ranges::count(greek, StudyKeys()), 1);
}

// A backslash separates values.
void TestSearchWords::noKeyHoldsABackslash() {
  for (const char* typed : {"a\\b", "\\", "\\\\", "ü\\"})
    for (const StudyKeys& k : questionsFor(searchWords(typed, "20260301")))
      QVERIFY((k.patientName + k.patientId + k.accessionNumber + k.description).find('\\') ==
              std::string::npos);
}

VOLUMEN_TEST(TestSearchWords);
#include "tst_search_words.moc"
