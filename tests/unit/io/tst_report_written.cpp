// Guards export.md: reports and key objects that are written are read back as the same values, in the study
// of their images.
#include "io/export/key_objects_dicom.h"
#include "io/export/report_dicom.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/document_study.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReportWritten : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void randomReportsComeBackEqual();
  void randomKeyObjectsComeBackEqual();
  void numbersComeBackExactly_data();
  void numbersComeBackExactly();
  void theClassFollowsTheShapes();
  void evidenceNamesEachObjectOnce();
  void theSeriesIsNew();
  void patientAndCharacterSetStay_data();
  void patientAndCharacterSetStay();
};

namespace {

constexpr const char* words[] = {"Lesion 1",         "Länge", "長さ",  "길이",
                                 "Größe der Läsion", "a^b=c", "Длина", "O'Neil \"x\" & <y>"};

// Random reports and key objects about the images of a study.
class ReportMaker {
 public:
  ReportMaker(int seed, const DocumentStudy& study) : chance_(std::uint64_t(seed)), study_(study) {}

  Report report() {
    Report report{code(), {}, {}};
    for (int n = chance_.below(4); n >= 0; --n) report.groups.push_back(group());
    return report;
  }

  KeyObjects keys() {
    KeyObjects keys{
        keyObjectTitles()[std::size_t(chance_.below(12))], chance_.oneIn(3) ? std::string() : word(), {}};
    for (const std::string& uid : study_.slices())
      if (keys.pictures.empty() || chance_.oneIn(2)) keys.pictures.push_back({uid, {}, {}, {}});
    if (chance_.oneIn(2)) keys.pictures.push_back(clip());
    return keys;
  }

 private:
  std::string word() { return words[chance_.below(int(std::size(words)))]; }

  Code code() {
    const char* values[] = {"410668003", "a-code-longer-than-sixteen", "urn:oid:1.2.3", "x"};
    return {values[chance_.below(4)], chance_.oneIn(2) ? "SCT" : "99VOLUMEN", word()};
  }
  Code maybeCode() { return chance_.oneIn(2) ? Code() : code(); }

  std::vector<ReportProperty> properties() {
    std::vector<ReportProperty> all;
    for (int n = chance_.below(3); n > 0; --n) all.push_back({code(), code()});
    return all;
  }

  ReferencedPicture clip() {
    ReferencedPicture picture{study_.clip(), {}, {}, {}};
    for (int frame = 0; frame < DocumentStudy::frames; ++frame)
      if (chance_.oneIn(2)) picture.frames.push_back(frame);
    return picture;
  }
  ReferencedPicture picture() {
    if (chance_.oneIn(3)) return clip();
    return {study_.slices()[std::size_t(chance_.below(3))], {}, {}, {}};
  }

  ReportShape shape() {
    using Type = ReportShape::Type;
    constexpr Type inPixels[] = {Type::point, Type::multipoint, Type::polyline, Type::circle, Type::ellipse};
    constexpr Type inPatient[] = {Type::point,   Type::multipoint, Type::polyline,
                                  Type::polygon, Type::ellipse,    Type::ellipsoid};
    constexpr int points[] = {1, 1, 2, 3, 2, 4, 6};
    ReportShape shape;
    shape.inPatient = chance_.oneIn(3);
    shape.type = shape.inPatient ? inPatient[chance_.below(6)] : inPixels[chance_.below(5)];
    const bool isOpen = shape.type == Type::multipoint || shape.type == Type::polyline;
    const int count = points[int(shape.type)] + (isOpen ? chance_.below(20) : 0);
    for (int n = 0; n < count; ++n) {
      const glm::vec3 p = chance_.vector() * chance_.power(-6, 6);
      shape.points.emplace_back(p.x, p.y, shape.inPatient ? p.z : 0);
    }
    shape.name = code();
    if (shape.inPatient)
      shape.frameOfReferenceUid = "1.2.3.4.99";
    else
      shape.pictures.push_back(picture());
    return shape;
  }
  std::vector<ReportShape> shapes() {
    std::vector<ReportShape> all;
    for (int n = chance_.below(3); n > 0; --n) all.push_back(shape());
    return all;
  }

  ReportMeasurement measurement() {
    ReportMeasurement all{code(), {}, {}, properties(), shapes()};
    if (chance_.oneIn(5)) return all;
    all.unit = code();
    all.value = chance_.between(-1, 1) * chance_.power(-30, 30);
    if (chance_.oneIn(4)) all.value = chance_.below(1000);
    return all;
  }

  MeasurementGroup group() {
    MeasurementGroup all;
    if (!chance_.oneIn(4)) all.trackingId = word();
    all.trackingUid = "2.25." + std::to_string(chance_.below(1000000));
    all.category = maybeCode(), all.finding = maybeCode(), all.site = maybeCode();
    all.evaluations = properties();
    for (int n = chance_.below(4); n > 0; --n) all.measurements.push_back(measurement());
    all.shapes = shapes();
    for (int n = chance_.below(3); n > 0; --n) all.pictures.push_back(picture());
    if (chance_.oneIn(4)) all.pictures.push_back({study_.segmentation(), {}, {}, {1 + chance_.below(9)}});
    return all;
  }

  Chance chance_;
  const DocumentStudy& study_;
};

std::string textOf(DcmItem& data, const DcmTagKey& tag) {
  OFString text;
  data.findAndGetOFStringArray(tag, text, OFTrue);
  return text.c_str();
}

// The DICOM file that `write` makes, which must succeed.
std::unique_ptr<DcmFileFormat> written(const std::string& path, const Report& report,
                                       const DocumentStudy& study) {
  auto file = std::make_unique<DcmFileFormat>();
  const auto source = study.source();
  if (!source || !writeReport(report, *source, path) || file->loadFile(path.c_str()).bad()) return nullptr;
  return file;
}

}  // namespace

void TestReportWritten::randomReportsComeBackEqual() {
  const DocumentStudy study;
  const auto source = study.source();
  QVERIFY2(source, source ? "" : source.message().c_str());
  const Seeds seeds = seedsOf(300, 3000);
  const bool isChecked = !QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty();
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const Report report = ReportMaker(seed, study).report();
    const std::string path = study.path(numbered("sr", seed));
    const auto notes = writeReport(report, *source, path);
    QVERIFY2(notes && notes->empty(), qPrintable(QStringLiteral("seed %1").arg(seed)));
    const Result<Report> read = loadReport(path);
    QVERIFY2(read, read ? "" : read.message().c_str());
    QVERIFY2(*read == report, qPrintable(QStringLiteral("seed %1").arg(seed)));
    if (!isChecked || seed % 10 != 0) continue;
    const QStringList errors = dciodvfyErrors(QString::fromStdString(path));
    QVERIFY2(errors.isEmpty(), qPrintable(QStringLiteral("seed %1: ").arg(seed) + errors.join(u'\n')));
  }
}

void TestReportWritten::randomKeyObjectsComeBackEqual() {
  const DocumentStudy study;
  const auto source = study.source();
  QVERIFY(source);
  const Seeds seeds = seedsOf(100, 1000);
  const bool isChecked = !QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty();
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const KeyObjects keys = ReportMaker(seed, study).keys();
    const std::string path = study.path(numbered("ko", seed));
    const Status done = writeKeyObjects(keys, *source, path);
    QVERIFY2(done, done ? "" : done.message().c_str());
    const Result<KeyObjects> read = loadKeyObjects(path);
    QVERIFY2(read && *read == keys, qPrintable(QStringLiteral("seed %1").arg(seed)));
    if (!isChecked || seed % 10 != 0) continue;
    const QStringList errors = dciodvfyErrors(QString::fromStdString(path));
    QVERIFY2(errors.isEmpty(), qPrintable(errors.join(u'\n')));
  }
}

void TestReportWritten::numbersComeBackExactly_data() {
  QTest::addColumn<double>("value");
  QTest::addColumn<bool>("fits");  // in 16 characters
  QTest::newRow("a whole number") << 12.0 << true;
  QTest::newRow("a tenth") << 0.1 << true;
  QTest::newRow("zero") << 0.0 << true;
  QTest::newRow("a third has more digits than 16") << 1.0 / 3 << false;
  QTest::newRow("a negative third") << -1e5 / 3 << false;
  QTest::newRow("a small one") << -1.2345678901234567e-300 << false;
  QTest::newRow("a large one") << 1.7976931348623157e308 << false;
}

void TestReportWritten::numbersComeBackExactly() {
  QFETCH(double, value);
  QFETCH(bool, fits);
  const DocumentStudy study;
  const auto file = written(study.path("sr"), oneLength(study, value), study);
  QVERIFY(file);
  QCOMPARE(loadReport(study.path("sr"))->groups.at(0).measurements.at(0).value, std::optional(value));
  QVERIFY(textOf(*file->getDataset(), DCM_NumericValue).size() <= 16);
  QCOMPARE(bool(file->getDataset()->tagExists(DCM_FloatingPointValue, OFTrue)), !fits);
}

void TestReportWritten::theClassFollowsTheShapes() {
  const DocumentStudy study;
  Report report = oneLength(study);
  const auto flat = written(study.path("flat"), report, study);
  ReportShape& line = report.groups[0].measurements[0].shapes[0];
  line.inPatient = true, line.frameOfReferenceUid = "1.2.3.4.99";
  const auto deep = written(study.path("deep"), report, study);
  QVERIFY(flat && deep);
  QCOMPARE(textOf(*flat->getDataset(), DCM_SOPClassUID), std::string(UID_ComprehensiveSRStorage));
  QCOMPARE(textOf(*deep->getDataset(), DCM_SOPClassUID), std::string(UID_Comprehensive3DSRStorage));
}

void TestReportWritten::evidenceNamesEachObjectOnce() {
  const DocumentStudy study;
  Report report = oneLength(study);
  report.groups.push_back(report.groups[0]);
  report.groups[1].pictures = {{study.clip(), {}, {0, 2}, {}}, {study.slices()[1], {}, {}, {}}};
  const auto file = written(study.path("sr"), report, study);
  QVERIFY(file);
  DcmSequenceOfItems* evidence = nullptr;
  QVERIFY(
      file->getDataset()->findAndGetSequence(DCM_CurrentRequestedProcedureEvidenceSequence, evidence).good());
  QCOMPARE(evidence->card(), 1ul);
  QCOMPARE(textOf(*evidence->getItem(0), DCM_StudyInstanceUID), std::string("1.2.3.4"));
  DcmStack found;
  std::vector<std::string> uids;
  while (evidence->search(DCM_ReferencedSOPInstanceUID, found, ESM_afterStackTop, OFTrue).good()) {
    OFString uid;
    static_cast<DcmElement*>(found.top())->getOFString(uid, 0);
    uids.emplace_back(uid.c_str());
  }
  std::ranges::sort(uids);
  std::vector<std::string> wanted = {study.slices()[1], study.clip()};
  std::ranges::sort(wanted);
  QCOMPARE(uids, wanted);
}

void TestReportWritten::theSeriesIsNew() {
  const DocumentStudy study;
  const auto one = written(study.path("one"), oneLength(study), study);
  const auto two = written(study.path("two"), oneLength(study), study);
  QVERIFY(one && two);
  DcmDataset &a = *one->getDataset(), &b = *two->getDataset();
  QCOMPARE(textOf(a, DCM_StudyInstanceUID), std::string("1.2.3.4"));
  QCOMPARE(textOf(a, DCM_PatientID), std::string("P1"));
  QCOMPARE(textOf(a, DCM_SeriesNumber), std::string("13"));  // the segmentation has 12
  for (const DcmTagKey& tag : {DCM_SOPInstanceUID, DCM_SeriesInstanceUID}) {
    QVERIFY(textOf(a, tag).starts_with("2.25."));
    QVERIFY(textOf(a, tag) != textOf(b, tag));
  }
}

void TestReportWritten::patientAndCharacterSetStay_data() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("name");    // PatientName as stored in the images
  QTest::addColumn<QByteArray>("label");   // the text of the report, UTF-8
  QTest::addColumn<QByteArray>("newSet");  // what the report has
  QTest::addColumn<QByteArray>("newName");
  const auto row = [](const char* what, const QByteArray& set, const QByteArray& name, const char* label,
                      const QByteArray& newSet, const QByteArray& newName) {
    QTest::newRow(what) << set << name << QByteArray(label) << newSet << newName;
  };
  const QByteArray japanese = "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B", jp = "\\ISO 2022 IR 87";
  const QByteArray korean = "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7", kr = "\\ISO 2022 IR 149";
  row("Latin-1, plain text", "ISO_IR 100", "M\xfcller^Hans", "a", "ISO_IR 100", "M\xfcller^Hans");
  row("Latin-1 holds an umlaut", "ISO_IR 100", "M\xfcller^Hans", "Länge", "ISO_IR 100", "M\xfcller^Hans");
  row("Latin-1 holds no Japanese", "ISO_IR 100", "M\xfcller^Hans", "長さ", "ISO_IR 192", "Müller^Hans");
  row("Japanese, plain text", jp, japanese, "a", jp, japanese);
  row("Japanese, other text", jp, japanese, "Länge", "ISO_IR 192", "Yamada^Tarou=山田^太郎");
  row("Korean, plain text", kr, korean, "a", kr, korean);
  row("Korean, Korean text", kr, korean, "길이", "ISO_IR 192", "Hong^Gildong=洪^吉洞");
  row("UTF-8", "ISO_IR 192", "Müller^山田", "長さ", "ISO_IR 192", "Müller^山田");
  row("plain", "", "Smith^John", "a", "", "Smith^John");
  row("plain, other text", "", "Smith^John", "長さ", "ISO_IR 192", "Smith^John");
  row("UTF-8 that is declared as Latin-1", "ISO_IR 100", "Müller^Hans", "a", "ISO_IR 192", "Müller^Hans");
  row("letters that nothing declares", "", "Müller^Hans", "a", "ISO_IR 192", "Müller^Hans");
}

void TestReportWritten::patientAndCharacterSetStay() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  QFETCH(QByteArray, label);
  QFETCH(QByteArray, newSet);
  QFETCH(QByteArray, newName);
  const DocumentStudy study([&](DcmDataset& data) {
    if (!set.isEmpty()) data.putAndInsertString(DCM_SpecificCharacterSet, set.constData());
    data.putAndInsertString(DCM_PatientName, name.constData());
  });
  Report report = oneLength(study);
  report.groups[0].trackingId = label.toStdString();
  const auto file = written(study.path("sr"), report, study);
  QVERIFY(file);
  DcmDataset& data = *file->getDataset();
  QCOMPARE(QByteArray::fromStdString(textOf(data, DCM_SpecificCharacterSet)), newSet);
  QCOMPARE(QByteArray::fromStdString(textOf(data, DCM_PatientName)), newName);
  const Result<Report> read = loadReport(study.path("sr"));
  QVERIFY(read && read->groups.at(0).trackingId == label.toStdString());
  QVERIFY(read->warnings.empty());
}

VOLUMEN_TEST(TestReportWritten);
#include "tst_report_written.moc"
