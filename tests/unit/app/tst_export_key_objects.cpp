// Guards export.md: `volumen export --as ko` writes the chosen images, and wrong input of both formats is
// refused with a sentence.
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/report.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportKeyObjects : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keyImagesAreThoseOfTheList();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();
  void anExistingFileStays();
  void jsonSaysWhatWasWritten();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

void TestExportKeyObjects::keyImagesAreThoseOfTheList() {
  NEED_DATA(dataPath());
  const QString uid = QString::fromLatin1(clipUid);
  const auto keysOf = [&](const QString& images, const QStringList& more) -> std::optional<KeyObjects> {
    QFile::remove(at("ko.dcm"));
    const Outcome done =
        runProgram(QStringList{QStringLiteral("export"), QString::fromStdString(dataPath(clip)),
                               QStringLiteral("--as"), QStringLiteral("ko"), QStringLiteral("--images"),
                               images, QStringLiteral("-o"), at("ko.dcm")} +
                   more);
    const Result<KeyObjects> keys = loadKeyObjects(at("ko.dcm").toStdString());
    if (done.status != 0 || !keys) return {};
    return *keys;
  };
  const auto teaching = keysOf(uid + QStringLiteral("/34,") + uid + QStringLiteral("/1"),
                               {QStringLiteral("--title"), QStringLiteral("113004")});
  QVERIFY(teaching && teaching->pictures.size() == 1);
  QCOMPARE(teaching->title, (Code{"113004", "DCM", "For Teaching"}));
  QCOMPARE(teaching->pictures[0].sopInstanceUid, std::string(clipUid));
  QCOMPARE(teaching->pictures[0].frames, (std::vector{0, 33}));
  if (!QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty())
    QCOMPARE(newErrors(at("ko.dcm"), dataPath(clip)), QStringList());
  const auto whole = keysOf(uid + QStringLiteral("/3,") + uid, {});
  QVERIFY(whole && whole->pictures.size() == 1 && whole->pictures[0].frames.empty());
  QCOMPARE(whole->title, (Code{"113000", "DCM", "Of Interest"}));
}

void TestExportKeyObjects::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QByteArray>("shape");  // the JSON after its frame; empty: no file of shapes
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const QString& options, const char* shape, int status,
                      const char* says) {
    QTest::newRow(name) << options << QByteArray(shape) << status << QByteArray(says);
  };
  const QString sr = QStringLiteral("--as sr --roi SHAPES"), ko = QStringLiteral("--as ko --images ");
  const QString uid = QString::fromLatin1(clipUid);
  row("nothing said", {}, "", 2, "--as FORMAT, --deidentify or both");
  row("options of the other one", QStringLiteral("--as ko --keep uids"), "", 2, "go with --deidentify");
  row("an unknown format", QStringLiteral("--as gif"), "", 2, "\"gif\" is not one of sr, ko");
  row("no shapes", QStringLiteral("--as sr"), "", 2, "--as sr needs --roi FILE or --segments FILE.");
  row("no images", QStringLiteral("--as ko"), "", 2, "--as ko needs --images LIST.");
  row("images of a report", sr + QStringLiteral(" --images 1"), "", 2, "--images does not go with --as sr.");
  row("shapes of copies", QStringLiteral("--deidentify --roi SHAPES"), "", 2, "--roi goes with --as.");
  row("dates of a report", sr + QStringLiteral(" --shift-dates 3"), "", 2, "go with --deidentify.");
  row("shapes that are not there", sr, "", 1, "Cannot read the shapes");
  row("a length in pixels", sr, R"("kind": "length", "points": [[100, 360], [200, 360]])", 1,
      "not calibrated");
  row("an area in pixels", sr, R"("kind": "rectangle", "points": [[0, 400], [20, 410]])", 1,
      "not calibrated");
  row("a colour", sr, R"("kind": "probe", "points": [[184, 399]])", 1, "colour");
  row("a shape that leaves its image", sr, R"("kind": "angle", "points": [[-9, 1], [9, 9], [20, 1]])", 1,
      "reaches beyond its image");
  row("an arm without length", sr, R"("kind": "angle", "points": [[9, 9], [9, 9], [20, 1]])", 1,
      "[0] (angle): ");
  row("a frame that is no number", ko + uid + QStringLiteral("/x"), "", 2, "is not UID or UID/FRAME");
  row("frame 0", ko + uid + QStringLiteral("/0"), "", 2, "with frames from 1");
  row("a frame with an exponent", ko + uid + QStringLiteral("/1e0"), "", 2, "with frames from 1");
  row("an image without name", ko + uid + QStringLiteral(","), "", 2, "\"\" is not UID or UID/FRAME");
  row("a frame too many", ko + uid + QStringLiteral("/35"), "", 1, "has no frame 35.");
  row("an image that is not here", ko + QStringLiteral("1.2.3"), "", 1,
      "No image here has the SOPInstanceUID 1.2.3.");
  row("a title that rejects", ko + uid + QStringLiteral(" --title 113001"), "", 2,
      "--title: The title 113001 rejects images");
  row("an unknown title", ko + uid + QStringLiteral(" --title 7"), "", 2, "--title: There is no title 7.");
}

void TestExportKeyObjects::wrongInputIsRefused() {
  NEED_DATA(dataPath());
  QFETCH(QString, options);
  QFETCH(QByteArray, shape);
  QFETCH(int, status);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  const QString json = folder.filePath(QStringLiteral("shapes.json"));
  if (!shape.isEmpty()) {
    QFile file(json);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"([{"frame": {"instance": ")" + QByteArray(clipUid) + R"("}, )" + shape + "}]");
  }
  const QString out = folder.filePath(QStringLiteral("out.dcm"));
  const Outcome done = runProgram(
      QStringLiteral("export %1 %2 -o %3")
          .arg(QString::fromStdString(dataPath(clip)), options.replace(QLatin1String("SHAPES"), json), out));
  QVERIFY2(done.status == status && done.err.contains(says), done.err);
  QVERIFY(!QFile::exists(out));
}

void TestExportKeyObjects::anExistingFileStays() {
  NEED_DATA(dataPath());
  QFile file(at("there.dcm"));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write("mine") == 4);
  file.close();
  const Outcome done = runProgram({QStringLiteral("export"), QString::fromStdString(dataPath(clip)),
                                   QStringLiteral("--as"), QStringLiteral("ko"), QStringLiteral("--images"),
                                   QString::fromLatin1(clipUid), QStringLiteral("-o"), file.fileName()});
  QVERIFY2(done.status == 1 && done.err.contains("is there already"), done.err);
  QCOMPARE(contentsOf(file.fileName()), QByteArray("mine"));
}

void TestExportKeyObjects::jsonSaysWhatWasWritten() {
  NEED_DATA(dataPath());
  const Outcome done =
      runProgram({QStringLiteral("export"), QString::fromStdString(dataPath(clip)), QStringLiteral("--as"),
                  QStringLiteral("ko"), QStringLiteral("--images"), QString::fromLatin1(clipUid),
                  QStringLiteral("--json"), QStringLiteral("-o"), at("json.dcm")});
  QVERIFY2(done.status == 0, done.err);
  QCOMPARE(QJsonDocument::fromJson(done.out)[QStringLiteral("file")].toString(), at("json.dcm"));
}

VOLUMEN_TEST(TestExportKeyObjects);
#include "tst_export_key_objects.moc"
