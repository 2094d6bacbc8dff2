// Guards `volumen export --deidentify --deface`: copies of heads have air in place of the face and say so, in
// every encoding; all other values, and all pictures of others, are those of their sources.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <glm/geometric.hpp>
#include <set>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/made_head.h"
#include "tests/unit/deidentify/exported.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* mrOfHead = "mr-head-siemens-gap-175";

// The slices of one series, as acquired.
VolumePtr acquiredAt(const QString& path) {
  const auto study = openStudy(path.toStdString());
  if (!study || study->volumes.size() != 1) return nullptr;
  const auto loaded = loadSeries(study->volumes[0]);
  return loaded ? loaded->acquired : nullptr;
}

// The pixels of all copies, as their files have them.
std::multiset<QByteArray> pixelsIn(const QString& folder) {
  std::multiset<QByteArray> all;
  for (const QString& path : copiesIn(folder)) {
    const auto file = readAll(path.toStdString());
    const QByteArray bytes(reinterpret_cast<const char*>(file.data()), qsizetype(file.size()));
    all.insert(bytes.mid(bytes.lastIndexOf(QByteArray("\xe0\x7f\x10\x00", 4))));
  }
  return all;
}

std::string methodsOf(DcmDataset& data) {
  std::string all;
  for (long n = 0;; ++n) {
    DcmItem* item = nullptr;
    if (data.findAndGetSequenceItem(DCM_DeidentificationMethodCodeSequence, item, n).bad()) return all;
    all += textOf(*item, DCM_CodeValue) + " ";
  }
}

// Writes slices of a made head, 5 mm apart, without a word on what they show.
void writeHead(const QString& folder, const char* syntax) {
  constexpr int size = 64, slices = 54;
  constexpr double mm = 4, apartMm = 5;
  for (int k = 0; k < slices; ++k) {
    DicomPicture picture;
    picture.instance = k + 1;
    picture.columns = picture.rows = size;
    picture.position = {-128, -150, -165 + apartMm * k};
    picture.spacing = "4\\4";
    picture.bitsStored = 12;
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const HeadPart part = MadeHead{}.at(picture.position + glm::dvec3(mm * i, mm * j, 0));
        picture.pixels.push_back(part == HeadPart::air ? 5 : part == HeadPart::brain ? 600 : 300);
      }
    picture.edit = [](DcmDataset& data) {
      data.putAndInsertString(DCM_Modality, "MR");
      data.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\OTHER");
    };
    writeDicom(folder.toStdString() + "/" + std::to_string(k) + ".dcm", picture, syntax);
  }
}

}  // namespace

class TestDeidentifiedFaces : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyEncodingLosesItsFace_data();
  void everyEncodingLosesItsFace();
  void aRealHeadKeepsItsBrain();
  void whatIsNoHeadStays_data();
  void whatIsNoHeadStays();
  void aSecondRunFindsTheSame();

 private:
  Exported exported_;
};

void TestDeidentifiedFaces::everyEncodingLosesItsFace_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<QByteArray>("written");
  const auto row = [](const char* name, const char* syntax, const char* written) {
    QTest::newRow(name) << QByteArray(syntax) << QByteArray(written);
  };
  const char* const plain = UID_LittleEndianExplicitTransferSyntax;
  row("explicit little endian", plain, plain);
  row("implicit", UID_LittleEndianImplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax);
  row("big endian", UID_BigEndianExplicitTransferSyntax, UID_BigEndianExplicitTransferSyntax);
  row("deflated", UID_DeflatedExplicitVRLittleEndianTransferSyntax, plain);
  row("RLE", UID_RLELosslessTransferSyntax, plain);
  row("JPEG-LS", UID_JPEGLSLosslessTransferSyntax, plain);
}

void TestDeidentifiedFaces::everyEncodingLosesItsFace() {
  QFETCH(QByteArray, syntax);
  QFETCH(QByteArray, written);
  const QTemporaryDir source;
  writeHead(source.path(), syntax);
  const Outcome a = exported_.run(source.path(), {QStringLiteral("--deface")});
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("The face was taken away"), a.err);
  const QStringList copies = copiesIn(exported_.folder());
  QCOMPARE(copies.size(), 54);
  for (const QString& copy : copies) {
    const auto file = readWithDcmtk(copy);
    QVERIFY(file);
    DcmDataset& data = *file->getDataset();
    QCOMPARE(textOf(*file->getMetaInfo(), DCM_TransferSyntaxUID), written.toStdString());
    QCOMPARE(textOf(data, DCM_ImageType), std::string("DERIVED\\PRIMARY\\OTHER"));
    QCOMPARE(textOf(data, DCM_RecognizableVisualFeatures), std::string("NO"));
    QCOMPARE(methodsOf(data), std::string("113100 113102 113104 "));
  }
  const VolumePtr before = acquiredAt(source.path()), after = acquiredAt(exported_.folder());
  QVERIFY(before && after);
  QVERIFY(after->geometry() == before->geometry());
  int noses = 0;
  std::size_t n = 0;
  const glm::ivec3 size = before->size();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++n) {
        const glm::dvec3 p = before->geometry().patientFromVoxel({i, j, k});
        const HeadPart part = MadeHead{}.at(p);
        noses += part == HeadPart::nose;
        if (part == HeadPart::nose) QCOMPARE(after->valueAt(n), 5.0f);
        if (part == HeadPart::brain || p.y > 70) QCOMPARE(after->valueAt(n), before->valueAt(n));
      }
  QVERIFY(noses > 20);
}

// The slices next to the missing one are as acquired, too.
void TestDeidentifiedFaces::aRealHeadKeepsItsBrain() {
  const std::string path = dataPath(mrOfHead);
  NEED_DATA(path);
  const Outcome a = exported_.run(QString::fromStdString(path), {QStringLiteral("--deface")});
  QVERIFY2(a.status == 0, a.err);
  const VolumePtr before = acquiredAt(QString::fromStdString(path)), after = acquiredAt(exported_.folder());
  QVERIFY(before && after);
  QVERIFY(after->size() == before->size());
  std::size_t n = 0;
  int changed = 0;
  for (int k = 0; k < before->size().z; ++k)
    for (int j = 0; j < before->size().y; ++j)
      for (int i = 0; i < before->size().x; ++i, ++n) {
        if (before->valueAt(n) == after->valueAt(n)) continue;
        const glm::dvec3 p = before->geometry().patientFromVoxel({i, j, k});
        QCOMPARE(after->valueAt(n), 0.0f);
        QVERIFY(p.y < 65 && glm::distance(p, glm::dvec3(-4, -10, 45)) > 55);
        ++changed;
      }
  QVERIFY(changed > 1000000);
  NEED_DCIODVFY();
  const QString first = copiesIn(exported_.folder()).constFirst();
  const QStringList errors = dciodvfyErrors(first);
  QVERIFY(!exported_.run(QString::fromStdString(path)).status);
  QCOMPARE(errors, dciodvfyErrors(copiesIn(exported_.folder()).constFirst()));
}

void TestDeidentifiedFaces::whatIsNoHeadStays_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<bool>("isWarned");
  QTest::newRow("a chest") << QStringLiteral("ct-chest-lidc0314-138") << false;
  QTest::newRow("a phantom said to be a brain") << QStringLiteral("mr-head-ge-mprage-130") << true;
  QTest::newRow("several frames") << QStringLiteral("dicom-geometry/mr-enh-philips-phmag") << true;
}

void TestDeidentifiedFaces::whatIsNoHeadStays() {
  QFETCH(QString, source);
  QFETCH(bool, isWarned);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  const Outcome a =
      exported_.run(QString::fromStdString(path), {QStringLiteral("--deface"), QStringLiteral("--json")});
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.err.contains("A face may be recognised"), isWarned);
  const QJsonObject report = QJsonDocument::fromJson(a.out).object();
  QVERIFY(report[QStringLiteral("faceless")].isArray());
  QVERIFY(report[QStringLiteral("faceless")].toArray().isEmpty());
  const QString defaced = exported_.folder();
  QVERIFY(!exported_.run(QString::fromStdString(path)).status);
  const std::multiset<QByteArray> pixels = pixelsIn(defaced);
  QVERIFY(!pixels.empty());
  QVERIFY(pixels == pixelsIn(exported_.folder()));
}

void TestDeidentifiedFaces::aSecondRunFindsTheSame() {
  const QTemporaryDir source, target;
  writeHead(source.path(), UID_LittleEndianExplicitTransferSyntax);
  QStringList command{QStringLiteral("export"), source.path(), QStringLiteral("--deidentify"),
                      QStringLiteral("-o"),     target.path(), QStringLiteral("--key"),
                      exported_.pathOf("key")};
  QCOMPARE(runProgram(command + QStringList{QStringLiteral("--deface")}).status, 0);
  const Outcome again = runProgram(command + QStringList{QStringLiteral("--deface")});
  QCOMPARE(again.status, 0);
  QVERIFY2(again.out.contains("54 were there already"), again.out);
  const Outcome plain = runProgram(command);
  QVERIFY2(plain.status == 0 && plain.out.contains("54 files"), plain.out + plain.err);
  QCOMPARE(copiesIn(target.path()).size(), 2 * 54);
}

VOLUMEN_TEST(TestDeidentifiedFaces);
#include "tst_deidentified_faces.moc"
