// Guards import.md: character sets and numbers that deviate from the standard are read as they are meant,
// with one report a series.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestTextsAsMeant : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namesAreReadAsMeant_data();
  void namesAreReadAsMeant();
  void fieldCasesAreReadAsMeant_data();
  void fieldCasesAreReadAsMeant();
  void decimalCommas_data();
  void decimalCommas();
};

namespace {

// Makes three slices that all have the edit, which gives one warning.
Study studyWith(const DicomFolder& folder, const std::function<void(DcmDataset&)>& edit) {
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = edit;
    folder.add(numbered("s", n), picture);
  }
  return folder.open();
}

}  // namespace

void TestTextsAsMeant::namesAreReadAsMeant_data() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("warning");  // empty for none
  const auto row = [](const char* set, const char* bytes, const char* name, const char* warning) {
    QTest::newRow(set) << QByteArray(set) << QByteArray(bytes) << QString::fromUtf8(name)
                       << QByteArray(warning);
  };
  row("ISO_IR 100", "T\xe9st", "Tést", "");
  for (const char* set : {"ISO-IR 100", "ISO_IR100", "ISO IR 100", "iso_ir 100", "ISO 8859-1", "ISO_IR_100",
                          "ISO2022 IR 100", "ISOIR100", "LATIN1", "100"})
    row(set, "T\xe9st", "Tést", "read as ISO_IR 100");
  row("ISO_IR 192", "T\xc3\xa9st", "Tést", "");
  for (const char* set : {"UTF-8", "utf8", "ISO-IR 192", "ISO IR 192"})
    row(set, "T\xc3\xa9st", "Tést", "read as ISO_IR 192");
  row("", "T\xc3\xa9st", "Tést", "does not say so");
  row("ISO_IR 6", "T\xc3\xa9st", "Tést", "does not say so");
  row("KLINGON", "T\xc3\xa9st", "Tést", "is not known");
  row("ISO-IR 144", "\xbf\xd5\xe2\xe0", "Петр", "read as ISO_IR 144");
  row("\\ISO_IR 13", "\xc3\xbd\xc4^\xb9\xb0\xbd", "ﾃｽﾄ^ｹｰｽ", "read as ISO_IR 13");
  row("\\ISO 2022 IR 100", "T\xe9st^C\xe4se", "Tést^Cäse", "read as ISO_IR 100");
  row("ISO_IR 13", "\xc3\xbd\xc4^\xb9\xb0\xbd", "ﾃｽﾄ^ｹｰｽ", "");
  row("\\ISO 2022 IR 87", "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B", "Yamada^Tarou=山田^太郎", "");
  row("KLINGON\\FERENGI", "Test", "Test", "");  // plain text needs no set
}

void TestTextsAsMeant::namesAreReadAsMeant() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, bytes);
  QFETCH(QString, name);
  QFETCH(QByteArray, warning);
  const DicomFolder folder;
  const Study study = studyWith(folder, [&](DcmDataset& d) {
    if (!set.isEmpty()) d.putAndInsertString(DCM_SpecificCharacterSet, set.constData());
    d.putAndInsertString(DCM_PatientName, bytes.constData());
  });
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(study.volumes[0].patientName), name);
  const std::vector<Warning>& warnings = study.volumes[0].warnings;
  QCOMPARE(warnings.size(), std::size_t(warning.isEmpty() ? 0 : 1));
  if (!warning.isEmpty()) QVERIFY2(warns(warnings, warning.toStdString()), warnings[0].sentence.c_str());
}

void TestTextsAsMeant::fieldCasesAreReadAsMeant_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("warning");
  QTest::newRow("c33m-first-empty-ir13") << QString::fromUtf8("ﾃｽﾄ^ｹｰｽ") << QByteArray("read as ISO_IR 13");
  QTest::newRow("c33o-iso-ir-100-hyphen") << QString::fromUtf8("Tést^Cäse") << QByteArray("no term");
  QTest::newRow("c33p-utf-8-as-term") << QString::fromUtf8("Tést^Cäse") << QByteArray("no term");
  QTest::newRow("c13-decimal-comma") << QStringLiteral("Test^Case") << QByteArray("decimal commas");
}

void TestTextsAsMeant::fieldCasesAreReadAsMeant() {
  NEED_DATA(dataPath());
  QFETCH(QString, name);
  QFETCH(QByteArray, warning);
  const auto study = openStudy(dataPath(std::string("field-cases/") + QTest::currentDataTag()));
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  const Series& series = study->volumes[0];
  QCOMPARE(QString::fromStdString(series.patientName), name);
  QCOMPARE(std::ranges::count_if(
               series.warnings,
               [&](const Warning& w) { return w.sentence.find(warning.toStdString()) != std::string::npos; }),
           1);
}

void TestTextsAsMeant::decimalCommas_data() {
  QTest::addColumn<QByteArray>("spacing");
  QTest::addColumn<double>("mm");  // 0 if not calibrated
  QTest::addColumn<bool>("told");
  QTest::newRow("points") << QByteArray("0.143\\0.143") << 0.143 << false;
  QTest::newRow("commas") << QByteArray("0,143\\0,143") << 0.143 << true;
  QTest::newRow("with an exponent") << QByteArray("1,43E-1\\1,43e-1") << 0.143 << true;
  QTest::newRow("one of each") << QByteArray("0.143\\0,143") << 0.143 << true;
  QTest::newRow("thousands") << QByteArray("1,234.5\\1,234.5") << 0.0 << false;
  QTest::newRow("commas between values") << QByteArray("0,143,0,143") << 0.0 << false;
}

void TestTextsAsMeant::decimalCommas() {
  QFETCH(QByteArray, spacing);
  QFETCH(double, mm);
  QFETCH(bool, told);
  const DicomFolder folder;
  const Study study =
      studyWith(folder, [&](DcmDataset& d) { d.putAndInsertString(DCM_PixelSpacing, spacing.constData()); });
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.calibrated, mm > 0);
  if (mm > 0) QCOMPARE(series.acquired.spacing(), glm::dvec3(mm, mm, 1));
  QCOMPARE(warns(series.warnings, "decimal commas"), told);
}

VOLUMEN_TEST(TestTextsAsMeant);
#include "tst_texts_as_meant.moc"
