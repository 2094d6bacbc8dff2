// Guards which texts count as holding a name: order, separators, case, accents, scripts and lengths;
// and which count as holding an ID.
#include "io/deidentify/identifying_texts.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestIdentifyingTexts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namesAreFound_data();
  void namesAreFound();
  void identifiersAreFound_data();
  void identifiersAreFound();
};

namespace {

// Returns an element in implicit VR.
QByteArray implicitElement(std::uint32_t tag, QByteArray value) {
  if (value.size() % 2) value += ' ';
  QByteArray bytes;
  for (const int shift : {16, 24, 0, 8}) bytes += char(tag >> shift & 0xff);
  for (const int shift : {0, 8, 16, 24}) bytes += char(value.size() >> shift & 0xff);
  return bytes + value;
}

// Returns whether a text holds what the elements of a data set identify.
bool isFoundIn(const QString& text, const QByteArray& bytes) {
  const dicom::Bytes view(reinterpret_cast<const std::uint8_t*>(bytes.constData()),
                          std::size_t(bytes.size()));
  const auto scan = dicom::scanDataSet(view, 0, view.size(), {false, false});
  const ConfidentialityProfile profile({});
  return scan && IdentifyingTexts(dicom::DataSet(view, scan->elements), profile).isIn(text.toStdString());
}

}  // namespace

void TestIdentifyingTexts::namesAreFound_data() {
  QTest::addColumn<QByteArray>("characters");
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QString>("text");
  QTest::addColumn<bool>("isFound");
  const auto row = [](const char* title, const char* name, const char* text, bool isFound = true,
                      const char* characters = "ISO_IR 192") {
    QTest::newRow(title) << QByteArray(characters) << QByteArray(name) << QString::fromUtf8(text) << isFound;
  };
  row("a long part", "Mustermann^Erika", "of MUSTERMANN");
  row("a long part in a word", "Mustermann^Erika", "Mustermanns");
  row("a part of four letters", "Bran^Arvid", "seen by bran");
  row("no part of four letters in a word", "Bran^Arvid", "Brandenburg", false);
  row("the value itself", "Ng^Al", "Ng^Al");
  row("short, by a blank", "Doe^Jo", "DOE JO");
  row("short, by a comma", "Li^Bo", "Li, Bo");
  row("short, without anything between", "Li^Bo", "LIBO");
  row("short, the other way round", "Li^Bo", "of Bo_LI, seen");
  row("short, not in a word", "Li^Bo", "Libor", false);
  row("two letters alone are a word", "Li^Bo", "WIN Li", false);
  row("a family name of three letters", "Max^Mo", "max");
  row("three letters not in a word", "Max^Mo", "maximum", false);
  row("a given name of three letters", "Quillfeather^Ada", "ada", false);
  row("initials apart", "A^B", "by A.B.");
  row("initials as a word", "A^B", "AB", false);
  row("an apostrophe and a hyphen", "O'Neill-Smith^Mary", "ONeill Smith");
  row("half of a double name", "O'Neill-Smith^Mary", "smith");
  row("an umlaut spelled", "M\xc3\xbcller^J\xc3\xb6rg", "seen Mueller");
  row("an umlaut without its dots", "M\xc3\xbcller^J\xc3\xb6rg", "muller");
  row("an umlaut where the name spells it", "Mueller^J", "M\xc3\x9cLLER");
  row("a sharp s", "Wei\xc3\x9f^Ute", "WEISS");
  row("an accent", "Andr\xc3\xa9^Luc", "andre");
  row("a blank in place of the caret", "Li Bo", "bo li");
  row("the first of two given names", "Li^Bo Ann", "Bo Li");
  const char* const kanji = "\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B";
  const QByteArray yamada = QByteArray("Yamada^Tarou=") + kanji;
  row("ideographs by code extensions", yamada.constData(),
      "report of \xe5\xb1\xb1\xe7\x94\xb0 \xe5\xa4\xaa\xe9\x83\x8e", true, "\\ISO 2022 IR 87");
  row("a family name of two ideographs", yamada.constData(), "x\xe5\xb1\xb1\xe7\x94\xb0x", true,
      "\\ISO 2022 IR 87");
  row("one ideograph of a family name", "Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab", "\xe7\x8e\x8b", false,
      "GB18030");
  row("ideographs without a blank", "Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab",
      "of \xe7\x8e\x8b\xe5\xb0\x8f\xe4\xb8\x9c", true, "GB18030");
}

void TestIdentifyingTexts::namesAreFound() {
  QFETCH(QByteArray, characters);
  QFETCH(QByteArray, name);
  QFETCH(QString, text);
  const QByteArray bytes = implicitElement(0x00080005, characters) + implicitElement(0x00100010, name);
  QTEST(isFoundIn(text, bytes), "isFound");
}

void TestIdentifyingTexts::identifiersAreFound_data() {
  QTest::addColumn<QByteArray>("id");
  QTest::addColumn<QString>("text");
  QTest::addColumn<bool>("isFound");
  const auto row = [](const char* title, const char* id, const char* text, bool isFound = true) {
    QTest::newRow(title) << QByteArray(id) << QString::fromUtf8(text) << isFound;
  };
  row("as written", "770042ZZ", "id 770042zz");
  row("as written in a longer word", "AB12", "SLAB123");
  row("over two values", "770042ZZ", "7700\\42ZZ");
  row("with a hyphen", "770042ZZ", "of 7700-42ZZ, seen");
  row("with a blank", "770042ZZ", "7700 42ZZ");
  row("without its hyphens", "PID-77-X", "PID77X");
  row("with other signs", "PID-77-X", "PID\\77\\X");
  row("with signs in a longer word", "PID-77-X", "copyPID.77.Xa");
  row("short, with signs", "AB12", "AB-12");
  row("short, with signs in a longer word", "AB12", "SLAB-12", false);
  row("letters with signs", "STATION", "STA-TION");
  row("letters over words", "ANTHEM", "plant hemisphere", false);
  row("six digits with a sign", "770042", "7700-42");
  row("six digits with signs in a longer number", "770042", "1770-042", false);
  row("five digits with a sign", "77004", "77.004", false);
  row("four digits of a date", "0102", "2001-02-03", false);
  row("three characters", "A12", "A12", false);
}

void TestIdentifyingTexts::identifiersAreFound() {
  QFETCH(QByteArray, id);
  QFETCH(QString, text);
  QTEST(isFoundIn(text, implicitElement(0x00100020, id)), "isFound");
}

VOLUMEN_TEST(TestIdentifyingTexts);
#include "tst_identifying_texts.moc"
