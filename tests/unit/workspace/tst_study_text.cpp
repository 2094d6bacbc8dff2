// Guards words shared by the window and `info`: a study's line, and what of a folder is not shown.
#include <QTest>

#include "io/study/study.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestStudyText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void studyIsDateAndDescription_data();
  void studyIsDateAndDescription();
  void filesThatAreNotShownAreCounted_data();
  void filesThatAreNotShownAreCounted();
};

void TestStudyText::studyIsDateAndDescription_data() {
  QTest::addColumn<QString>("date");
  QTest::addColumn<QString>("description");
  QTest::addColumn<QString>("text");
  const auto row = [](const char* name, const char* date, const char* description, const char* text) {
    QTest::newRow(name) << QString::fromLatin1(date) << QString::fromLatin1(description)
                        << QString::fromLatin1(text);
  };
  row("both", "20260314", "CHEST", "2026-03-14 CHEST");
  row("date alone", "20260314", "", "2026-03-14");
  row("date of ACR-NEMA", "2026.03.14", "CHEST", "2026-03-14 CHEST");
  row("date that is none", "14 March", "CHEST", "14 March CHEST");
  row("description alone", "", "CHEST", "(no date) CHEST");
  row("neither", "", "", "(no date)");
}

void TestStudyText::studyIsDateAndDescription() {
  QFETCH(QString, date);
  QFETCH(QString, description);
  QFETCH(QString, text);
  Series series;
  series.format = "DICOM";
  series.studyDate = date.toStdString();
  series.studyDescription = description.toStdString();
  QCOMPARE(studyText(series), text);
}

void TestStudyText::filesThatAreNotShownAreCounted_data() {
  QTest::addColumn<int>("refused");
  QTest::addColumn<int>("others");
  QTest::addColumn<QString>("text");
  const auto row = [](int refused, int others, const char* text) {
    QTest::addRow("%d refused, %d others", refused, others) << refused << others << QString::fromLatin1(text);
  };
  row(0, 0, "");
  row(1, 0, "1 file could not be read.");
  row(8, 0, "8 files could not be read.");
  row(8, 77, "8 files could not be read; 77 others are not images.");
  row(1, 1, "1 file could not be read; 1 other is not an image.");
  row(0, 1, "1 file is not an image.");
  row(0, 2, "2 files are not images.");
}

void TestStudyText::filesThatAreNotShownAreCounted() {
  QFETCH(int, refused);
  QFETCH(int, others);
  QFETCH(QString, text);
  Study study;
  study.refused.resize(std::size_t(refused));
  study.other.resize(std::size_t(others));
  QCOMPARE(unreadText(study), text);
  QCOMPARE(noVolumesText(study), text);
  study.images.resize(1);
  QVERIFY2(unreadText(study) == text, "pictures that are no volumes are shown as frames");
  const QString behind = (text + QStringLiteral(" 1 picture is no volume.")).trimmed();
  QCOMPARE(noVolumesText(study), behind);
  study.images.resize(2);
  QVERIFY(noVolumesText(study).endsWith(QStringLiteral("2 pictures are no volumes.")));
}

VOLUMEN_TEST(TestStudyText);
#include "tst_study_text.moc"
