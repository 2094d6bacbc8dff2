// Guards design.md 7: every picture holds its warnings, and scripts can tell their kinds.
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestWarnings : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void theySayWhatTheyAreAbout();
  void theyStandInTheCornerUnlessSwitchedOff();
  void theyAreTheSameWithAnyFonts_data();
  void theyAreTheSameWithAnyFonts();
  void floatsAreLeftAlone();
  void withoutWarningsNothingChanges();
  void aWrongSceneIsToldBeforeAWindowOpens();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  // Renders the volume without spacing. The options end in -o and the path.
  QByteArray rendered(const char* options, const char* name) const {
    const Outcome a = runProgram(QStringLiteral("render %1 --size 300x200 %2 -o %3")
                                     .arg(at("bare.nrrd"), QLatin1String(options), at(name)));
    return a.status == 0 ? contentsOf(at(name)) : QByteArray();
  }
  QTemporaryDir folder_;
};

void TestWarnings::initTestCase() {
  QFile file(at("bare.nrrd"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, '\x7f'));
}

void TestWarnings::theySayWhatTheyAreAbout() {
  const Outcome a = runProgram(QStringLiteral("info %1 --json").arg(at("bare.nrrd")));
  const QJsonObject v =
      QJsonDocument::fromJson(a.out).object()[QStringLiteral("volumes")].toArray()[0].toObject();
  QCOMPARE(v[QStringLiteral("warningKinds")].toArray(), QJsonArray{QStringLiteral("notCalibrated")});
  QCOMPARE(v[QStringLiteral("warnings")].toArray().size(), 1);
}

void TestWarnings::theyStandInTheCornerUnlessSwitchedOff() {
  QVERIFY(!rendered("", "with.png").isEmpty());
  QVERIFY(!rendered("--no-warning-line", "without.png").isEmpty());
  const QImage with(at("with.png")), without(at("without.png"));
  for (const QImage& image : {with, without})
    QVERIFY(image.text(QStringLiteral("volumen-warnings"))
                .startsWith(QStringLiteral("notCalibrated: Not calibrated")));
  QRect where;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      if (with.pixel(x, y) != without.pixel(x, y)) where |= QRect(x, y, 1, 1);
  QVERIFY2(where.width() > 50 && where.height() > 6, "it can be read");
  QVERIFY2(QRect(0, 0, 150, 40).contains(where), "in the corner");
}

void TestWarnings::theyAreTheSameWithAnyFonts_data() {
  QTest::addColumn<QString>("fonts");
  for (const char* fonts : {"noto", "cantarell"}) QTest::newRow(fonts) << QString::fromLatin1(fonts);
}

void TestWarnings::theyAreTheSameWithAnyFonts() {
  QFETCH(QString, fonts);
  const auto drawn = [this](const QString& with) {
    const std::optional<Outcome> a =
        runWithFonts(with, {QStringLiteral("render"), at("bare.nrrd"), QStringLiteral("--size"),
                            QStringLiteral("300x200"), QStringLiteral("-o"), at("fonts.png")});
    QByteArrayList made;
    if (a) made << (a->status == 0 ? contentsOf(at("fonts.png")) : a->err);
    return made;
  };
  const QByteArrayList asHere = drawn(QStringLiteral("dejavu")), there = drawn(fonts);
  if (there.isEmpty()) QSKIP("fonts-noto-core or fonts-cantarell is not installed");
  QVERIFY(asHere.value(0).startsWith("\x89PNG"));
  QCOMPARE(there, asHere);
}

void TestWarnings::floatsAreLeftAlone() {
  const QByteArray with = rendered("", "with.nrrd");
  QVERIFY(!with.isEmpty());
  QCOMPARE(rendered("--no-warning-line", "without.nrrd"), with);
}

void TestWarnings::withoutWarningsNothingChanges() {
  const auto head = [this](const char* options, const char* name) {
    const QString line = QStringLiteral("render phantom:ct-head:32 --size 64x64 %1 -o %2");
    return runProgram(line.arg(QLatin1String(options), at(name))).status == 0 ? contentsOf(at(name))
                                                                              : QByteArray();
  };
  const QByteArray with = head("", "head.png");
  QVERIFY(!with.isEmpty() && !with.contains("volumen-warnings"));
  QCOMPARE(head("--no-warning-line", "head-without.png"), with);
}

void TestWarnings::aWrongSceneIsToldBeforeAWindowOpens() {
  const Outcome a = runProgram(QStringLiteral("open phantom:sphere:16 --scene %1").arg(at("bare.nrrd")));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.startsWith("volumen: " + at("bare.nrrd").toUtf8()), a.err);
  QCOMPARE(a.err.count('\n'), 1);
}

VOLUMEN_TEST(TestWarnings);
#include "tst_warnings.moc"
