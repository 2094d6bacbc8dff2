// Guards the words that the window and `info` share: a study's line, and what of a folder is not shown.
#include <QTest>

#include "tests/unit/suite.h"
#include "ui/workspace/text.h"

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
  QTest::addColumn<int>("images");
  QTest::addColumn<QString>("text");
  const auto row = [](int refused, int others, const char* text, int images = 0) {
    QTest::addRow("%d refused, %d others, %d images", refused, others, images)
        << refused << others << images << QString::fromLatin1(text);
  };
  row(0, 0, "");
  row(1, 0, "1 file could not be read.");
  row(8, 0, "8 files could not be read.");
  row(8, 77, "8 files could not be read; 77 others are not images.");
  row(1, 1, "1 file could not be read; 1 other is not an image.");
  row(0, 1, "1 file is not an image.");
  row(0, 2, "2 files are not images.");
  row(0, 0, "1 picture is no volume.", 1);
  row(1, 1, "1 file could not be read; 1 other is not an image. 2 pictures are no volumes.", 2);
}

void TestStudyText::filesThatAreNotShownAreCounted() {
  QFETCH(int, refused);
  QFETCH(int, others);
  QFETCH(int, images);
  QFETCH(QString, text);
  Study study;
  study.refused.resize(std::size_t(refused));
  study.other.resize(std::size_t(others));
  study.images.resize(std::size_t(images));
  QCOMPARE(unreadText(study), text);
}

VOLUMEN_TEST(TestStudyText);
#include "tst_study_text.moc"
