// Guards export.md: each DICOM format of `volumen export` keeps the patient's name in any script. The files
// are valid DICOM that volumen, DCMTK and pydicom read alike. Titles, and names of shapes and segments, are
// kept in any script, too.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <map>
#include <set>

#include "io/contours.h"
#include "io/open.h"
#include "io/presentation.h"
#include "io/report.h"
#include "io/segmentation.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/io/study_sources.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// An export format and its options. Words in capitals stand for files and texts of the test. `isUtf8` is
// true if the result is in UTF-8 whatever the source is in.
struct NamedFormat {
  const char *what, *options;
  bool isUtf8 = false;
};

constexpr NamedFormat namedFormats[] = {
    {"report", "sr --roi SHAPES"},
    {"key images", "ko --images IMAGE"},
    {"presentation", "gsps --roi SHAPES --window 40,400"},
    {"segmentation", "seg --segments SEGMENTS", true},
    {"structure set", "rtstruct --segments SEGMENTS"},
    {"rendering", "sc --size 24x24 --quality draft"},
    {"turn", "sc --size 24x24 --quality draft --turntable 2"},
    {"slice", "sc --plane coronal --size 24x24"},
    {"document", "pdf --pdf DOCUMENT --title TITLE"},
    {"slices", "series --plane coronal --spacing 80", true},
    {"slices on another grid", "series --onto OTHER", true},
    {"slices fused", "series --plane coronal --spacing 80 --overlay OTHER"},
    {"slices without face", "series --deface", true},
    {"slices without table", "series --remove-table", true},
    {"slices of segments", "series --segments SEGMENTS", true},
    {"slices without segments", "series --segments SEGMENTS --without-segments", true}};

// Returns the formats to try with a text. They are a third of all, which the length of the text chooses, or
// all if isThorough().
std::vector<NamedFormat> formatsFor(const QString& text) {
  std::vector<NamedFormat> formats;
  qsizetype n = text.size();
  for (const NamedFormat& format : namedFormats)
    if (n++ % 3 == 0 || isThorough()) formats.push_back(format);
  return formats;
}

// Returns the patients' names that volumen reads in a file or folder.
std::set<std::string> patientsIn(const QString& path) {
  std::set<std::string> names;
  const Result<Study> study = openStudy(path.toStdString());
  if (!study) return names;
  for (const Series& series : study->volumes) names.insert(series.patientName);
  for (const Image& image : study->images) names.insert(image.patientName);
  for (const DerivedObject& object : study->derived) names.insert(object.patientName);
  return names;
}

// Returns the name of a shape or segment, or the title, in a file with the character set `set`.
QString titleIn(const QString& path, std::string_view what, const QByteArray& set) {
  const std::string file = path.toStdString();
  std::string text;
  if (what == "report") text = loadReport(file)->groups.at(0).finding.meaning;
  if (what == "presentation") text = loadPresentation(file)->annotations.at(0).texts.at(0).text;
  if (what == "segmentation") text = loadSegmentation(file)->segments.at(0).label;
  if (what == "structure set") text = loadContours(file)->regions.at(0).name;
  if (what != "document") return QString::fromStdString(text).section(QStringLiteral("\r\n"), 0, 0);
  const QByteArray title = QByteArray::fromStdString(StoredFile(path).said(DCM_DocumentTitle));
  return set == "ISO_IR 192" ? QString::fromUtf8(title) : QString::fromLatin1(title);
}

// Returns the names of patients and physicians that pydicom reads, one line for each file, or its error
// message.
QStringList namesByPydicom(const QStringList& files) {
  const QString script = QStringLiteral(
      "import sys, pydicom\n"
      "for path in sys.argv[1:]:\n"
      " d = pydicom.dcmread(path)\n"
      " sys.stdout.buffer.write(f'{d.PatientName} {d.ReferringPhysicianName}\\n'.encode())\n");
  QProcess python;
  python.start(QStringLiteral("/usr/bin/python3"), QStringList{QStringLiteral("-c"), script} + files);
  if (!python.waitForFinished(120000)) return {python.errorString()};
  const QByteArray said =
      python.exitCode() == 0 ? python.readAllStandardOutput() : python.readAllStandardError();
  return QString::fromUtf8(said).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
}

}  // namespace

class TestExportNames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void allFormatsAreHere();
  void patientsStay_data() { addNames(); }
  void patientsStay();
  void titlesStay_data();
  void titlesStay();
  void blankNamesAreNone();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  // Writes the phantom as a scan of a patient named `name`, in the character set `set`.
  void writeNamed(const QString& folder, const QByteArray& set, const QByteArray& name) const;
  // Exports with `title_` as title. Returns the file, or a file from the middle of a series. Returns an
  // empty name if the export failed.
  QString exported(const QString& source, const NamedFormat& format, const QString& into) const;
  bool write(const QString& name, const QByteArray& bytes) const {
    QFile file(at(name));
    return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
  }
  // Gives this name to the shapes, the segments and the document that are exported.
  bool setTitle(const QString& title);

  QTemporaryDir folder_;
  QString title_;
  QByteArray segments_, uid_;
  double z_ = 0;  // position of the image `uid_`
};

void TestExportNames::initTestCase() {
  const QString scan = at(QStringLiteral("scan")), segments = at(QStringLiteral("made.seg.nrrd"));
  for (const QString& command : {QStringLiteral("convert phantom:ct-head:16 -o %1/").arg(scan),
                                 QStringLiteral("segment %1 --range 200:3000 -o %2").arg(scan, segments)}) {
    const Outcome done = runProgram(command);
    QVERIFY2(done.status == 0, done.err);
  }
  segments_ = contentsOf(segments);
  QVERIFY(segments_.contains("Segment0_Name:=Range 200:3000\n"));
  StoredFile middle(storedFilesIn(scan).value(8));
  uid_ = QByteArray::fromStdString(middle.said(DCM_SOPInstanceUID));
  z_ = middle.numbers(DCM_ImagePositionPatient).at(2);
  QVERIFY(write(QStringLiteral("DOCUMENT"), "%PDF-1.4\nof a report\n%%EOF\n"));
  QVERIFY(setTitle(QStringLiteral("plain")));
}

bool TestExportNames::setTitle(const QString& title) {
  title_ = title;
  QByteArray line = title.toUtf8();
  line.replace('\\', "\\\\").replace('\n', "\\n");
  const QJsonArray from{0, 0, z_}, to{20, 10, z_};
  const QJsonObject shape{{QStringLiteral("kind"), QStringLiteral("length")},
                          {QStringLiteral("name"), title},
                          {QStringLiteral("points"), QJsonArray{from, to}}};
  return write(QStringLiteral("SHAPES"), QJsonDocument(QJsonArray{shape}).toJson()) &&
         write(QStringLiteral("called.seg.nrrd"), QByteArray(segments_).replace("Range 200:3000", line));
}

void TestExportNames::writeNamed(const QString& folder, const QByteArray& set, const QByteArray& name) const {
  QVERIFY(QDir().mkpath(folder));
  for (const QString& path : storedFilesIn(at(QStringLiteral("scan")))) {
    StoredFile slice(path);
    DcmDataset& data = *slice.file.getDataset();
    data.findAndDeleteElement(DCM_SpecificCharacterSet);
    if (!set.isEmpty()) data.putAndInsertString(DCM_SpecificCharacterSet, set.constData());
    for (const DcmTagKey& tag : {DCM_PatientName, DCM_ReferringPhysicianName})
      data.putAndInsertString(tag, name.constData());
    const QString copy = QDir(folder).filePath(QFileInfo(path).fileName());
    QVERIFY(slice.file.saveFile(copy.toUtf8().constData(), EXS_LittleEndianExplicit).good());
  }
}

QString TestExportNames::exported(const QString& source, const NamedFormat& format,
                                  const QString& into) const {
  const std::map<QString, QString> meant{{QStringLiteral("SHAPES"), at(QStringLiteral("SHAPES"))},
                                         {QStringLiteral("IMAGE"), QString::fromLatin1(uid_)},
                                         {QStringLiteral("SEGMENTS"), at(QStringLiteral("called.seg.nrrd"))},
                                         {QStringLiteral("DOCUMENT"), at(QStringLiteral("DOCUMENT"))},
                                         {QStringLiteral("TITLE"), title_},
                                         {QStringLiteral("OTHER"), at(QStringLiteral("scan"))}};
  const QString out = QDir(into).filePath(QLatin1String(format.what) + QStringLiteral(".dcm"));
  QStringList words{QStringLiteral("export"), source, QStringLiteral("-o"), out, QStringLiteral("--as")};
  for (const QString& word : QString::fromLatin1(format.options).split(QLatin1Char(' '))) {
    const auto known = meant.find(word);
    words << (known == meant.end() ? word : known->second);
  }
  const Outcome done = runProgram(words);
  if (done.status != 0) qWarning("%s", done.err.constData());
  if (done.status != 0 || QFileInfo(out).isFile()) return done.status == 0 ? out : QString();
  const QStringList files = storedFilesIn(out);
  return files.value(files.size() / 2);
}

// The formats that are not tested here are not DICOM.
void TestExportNames::allFormatsAreHere() {
  const Outcome help = runProgram({QStringLiteral("export"), QStringLiteral("--help")});
  const QRegularExpression list(QStringLiteral("--as ([a-z0-9]+\\|[a-z0-9|]+)"));
  const QStringList known = list.match(QString::fromUtf8(help.out)).captured(1).split(QLatin1Char('|'));
  std::set<QString> left(known.begin(), known.end());
  QVERIFY2(left.size() > 5, help.out);
  for (const NamedFormat& format : namedFormats)
    left.erase(QString::fromLatin1(format.options).section(QLatin1Char(' '), 0, 0));
  QCOMPARE(left, (std::set<QString>{QStringLiteral("apng"), QStringLiteral("mp4"), QStringLiteral("stl")}));
}

void TestExportNames::patientsStay() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  QFETCH(QString, text);
  const QTemporaryDir folder;
  const QString source = folder.filePath(QStringLiteral("source"));
  writeNamed(source, set, name);
  QStringList files = storedFilesIn(source).mid(0, 1);
  for (const NamedFormat& format : formatsFor(text)) {
    const QString file = exported(source, format, folder.path());
    QVERIFY2(!file.isEmpty(), format.what);
    files << file;
    StoredFile stored(file);
    QCOMPARE(QByteArray::fromStdString(stored.said(DCM_SpecificCharacterSet)),
             format.isUtf8 ? QByteArray("ISO_IR 192") : set);
    for (const DcmTagKey& tag : {DCM_PatientName, DCM_ReferringPhysicianName})
      QCOMPARE(QByteArray::fromStdString(stored.said(tag)), format.isUtf8 ? text.toUtf8() : name);
    const bool isDocument = std::string_view(format.what) == "document";  // volumen reads no documents
    if (!isDocument) QCOMPARE(patientsIn(file), std::set{text.toStdString()});
    if (QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty()) continue;
    QCOMPARE(newErrors(file, files.constFirst().toStdString()), QStringList());
  }
  QStringList byPydicom = namesByPydicom(files);
  byPydicom.replaceInStrings(QStringLiteral("\x1b$)A"), QString());  // version 2.3 keeps escapes of GB2312
  if (byPydicom.constLast().contains(QLatin1String("No module named")))
    QSKIP("pydicom (python3-pydicom) is not installed");
  QCOMPARE(byPydicom, QStringList(files.size(), text + QLatin1Char(' ') + text));
}

void TestExportNames::titlesStay_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("shown");  // the text as read again
  QTest::addColumn<QByteArray>("set");
  const auto row = [](const char* what, const QString& text, const QString& shown, const char* set) {
    QTest::newRow(what) << text << shown << QByteArray(set);
  };
  const auto kept = [&](const char* what, const char* text, const char* set) {
    row(what, QString::fromUtf8(text), QString::fromUtf8(text), set);
  };
  kept("in the set of the source", "Größe", "ISO_IR 100");
  kept("Cyrillic", "опухоль", "ISO_IR 192");
  kept("Japanese", "腫瘍の長さ", "ISO_IR 192");
  kept("Korean", "종양", "ISO_IR 192");
  kept("Arabic", "ورم", "ISO_IR 192");
  kept("beyond 16 bits", "🫁 left", "ISO_IR 192");
  kept("with an accent of its own", "e\u0301", "ISO_IR 192");
  kept("with delimiters of names", "a^b=c", "ISO_IR 100");
  row("with control characters",
      QStringLiteral("a\tb\x01"
                     "c\x1b$Bd"),
      QStringLiteral("a b c $Bd"), "ISO_IR 100");
  row("of two lines", QStringLiteral("one\ntwo"), QStringLiteral("one two"), "ISO_IR 100");
}

// The study is that of Nuñez, in Latin-1.
void TestExportNames::titlesStay() {
  QFETCH(QString, text);
  QFETCH(QString, shown);
  QFETCH(QByteArray, set);
  const QTemporaryDir folder;
  const QString source = folder.filePath(QStringLiteral("source"));
  writeNamed(source, "ISO_IR 100",
             "Nu\xf1"
             "ez");
  QVERIFY(setTitle(text));
  for (const NamedFormat& format : formatsFor(text)) {
    const std::string_view what = format.what;
    const bool isTitled = QString::fromLatin1(format.options)
                              .contains(QRegularExpression(QStringLiteral("SHAPES|SEGMENTS|TITLE")));
    if (!isTitled) continue;
    const QString file = exported(source, format, folder.path());
    QVERIFY2(!file.isEmpty(), format.what);
    StoredFile stored(file);
    if (!format.isUtf8) QCOMPARE(QByteArray::fromStdString(stored.said(DCM_SpecificCharacterSet)), set);
    const bool isInUtf8 = format.isUtf8 || set == "ISO_IR 192";
    QCOMPARE(QByteArray::fromStdString(stored.said(DCM_PatientName)), isInUtf8 ? QByteArray("Nu\xc3\xb1"
                                                                                            "ez")
                                                                               : QByteArray("Nu\xf1"
                                                                                            "ez"));
    const bool isSeries = what.starts_with("slices");  // its description may name segments instead
    if (!isSeries) QCOMPARE(titleIn(file, what, set).simplified(), shown);
    if (QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty()) continue;
    QCOMPARE(newErrors(file, storedFilesIn(source).constFirst().toStdString()), QStringList());
  }
}

void TestExportNames::blankNamesAreNone() {
  QVERIFY(setTitle(QStringLiteral(" \t")));
  const auto report =
      loadReport(exported(at(QStringLiteral("scan")), namedFormats[0], folder_.path()).toStdString());
  QVERIFY2(report, report ? "" : report.message().c_str());
  QCOMPARE(report->groups.at(0).trackingId, std::string("Cornerstone3DTools@^0.1.0:Length"));
  QCOMPARE(report->groups[0].finding, Code());
  const auto state =
      loadPresentation(exported(at(QStringLiteral("scan")), namedFormats[2], folder_.path()).toStdString());
  QVERIFY2(state, state ? "" : state.message().c_str());
  QCOMPARE(state->annotations.at(0).texts.at(0).text, std::string("22.4 mm"));
}

VOLUMEN_TEST(TestExportNames);
#include "tst_export_names.moc"
