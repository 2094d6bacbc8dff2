// Guards resources/docs/segment.md, "Save and import files", in the window: the questions asked before
// segments are written.
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QMessageBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <cmath>

#include "results/text/value_text.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Two segments, and a folder for exported files.
struct ExportWindow : SegmentWindow {
  QTemporaryDir folder;

  QString at(const QString& name) const { return folder.filePath(name); }
  QStringList files() const { return QDir(folder.path()).entryList(QDir::Files | QDir::Hidden, QDir::Name); }
  bool putOld(const QString& name) const {
    QFile file(at(name));
    return file.open(QIODevice::WriteOnly) && file.write("old") == 3;
  }
  bool isOld(const QString& name) const {
    QFile file(at(name));
    return file.open(QIODevice::ReadOnly) && file.readAll() == "old";
  }
  void startExport(const QString& name) {
    child<QAction>("exportSegments")->trigger();
    answer(*this, "segmentDialog", at(name));
  }
  /// Returns whether the surfaces are computed and can be saved.
  bool areMade() {
    return QTest::qWaitFor([this] { return button("surfaceSave") && button("surfaceSave")->isEnabled(); },
                           longest);
  }
  QTableWidget* table() { return child<QTableWidget>("surfaceTable"); }
  QStringList column(int number) {
    QStringList cells;
    for (int row = 0; row < table()->rowCount(); ++row) cells << table()->item(row, number)->text();
    return cells;
  }
  /// Saves surfaces with the default choices of the dialog.
  bool saveSurfaces(const QString& name) {
    startExport(name);
    return areMade() && press("surfaceSave");
  }
  void reduceBy(const char* mm) {
    click("surfaceReduce");
    auto* field = child<QDoubleSpinBox>("surfaceReduceMm");
    QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(field, QLatin1String(mm));
    QTest::keyClick(field, Qt::Key_Return);
  }
  /// Returns the number of triangles of a binary STL.
  QString trianglesOf(const QString& name) const {
    return QString::number((QFile(at(name)).size() - 84) / 50);
  }
  /// Returns null if nothing is asked.
  QMessageBox* question() {
    for (auto* box : window.findChildren<QMessageBox*>(QStringLiteral("replaceBox")))
      if (box->isVisible()) return box;
    return nullptr;
  }
  void choose(const QString& text) {
    for (QAbstractButton* each : question()->buttons())
      if (each->text().remove(QLatin1Char('&')) == text) return QTest::mouseClick(each, Qt::LeftButton);
    QFAIL("there is no such button");
  }
};

const QString firstStl = QStringLiteral("a-800 to 1200 HU.stl"),
              secondStl = QStringLiteral("a-400 to 600 HU.stl");

}  // namespace

class TestSegmentExport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatWouldBeReplacedIsAskedOnce_data();
  void whatWouldBeReplacedIsAskedOnce();
  void nothingIsAskedOfNewFiles();
  void surfacesAreToldBeforeTheyAreSaved();
  void surfacesAreReduced();
  void theLargestPartAlone();
  void allSurfacesStandInOneFile();
  void theSegmentsAreThoseOfWhenItWasAsked();
  void nothingIsWrittenWhereItIsCancelled();
};

void TestSegmentExport::whatWouldBeReplacedIsAskedOnce_data() {
  QTest::addColumn<QString>("typed");
  QTest::addColumn<QStringList>("there");
  QTest::addColumn<bool>("replaces");
  const auto row = [](const char* name, const char* typed, const QStringList& there) {
    for (const bool replaces : {false, true})
      QTest::addRow("%s, %s", name, replaces ? "replaced" : "left")
          << QString::fromLatin1(typed) << there << replaces;
  };
  row("one of two surfaces", "a.stl", {secondStl});
  row("both surfaces", "a.stl", {firstStl, secondStl});
  row("a table of labels", "a.nii.gz", {QStringLiteral("a.label")});
}

void TestSegmentExport::whatWouldBeReplacedIsAskedOnce() {
  QFETCH(QString, typed);
  QFETCH(QStringList, there);
  QFETCH(bool, replaces);
  ExportWindow w;
  QVERIFY(w.makeBoth());
  for (const QString& name : there) QVERIFY(w.putOld(name));
  const QStringList before = w.files();
  w.startExport(typed);
  if (typed.endsWith(QLatin1String(".stl"))) {
    QVERIFY(w.areMade());
    w.click("surfaceSave");
  }
  QTRY_VERIFY_WITH_TIMEOUT(w.question(), longest);
  for (const QString& name : {firstStl, secondStl, QStringLiteral("a.label")})
    QCOMPARE(w.question()->informativeText().contains(name), there.contains(name));
  QCOMPARE(w.files(), before);
  w.choose(replaces ? QStringLiteral("Replace") : QStringLiteral("Cancel"));
  QVERIFY(w.idle());
  QTRY_VERIFY_WITH_TIMEOUT(!w.question(), longest);
  for (const QString& name : there) QCOMPARE(w.isOld(name), !replaces);
  QCOMPARE(w.files().size(), replaces ? 2 : before.size());
}

void TestSegmentExport::nothingIsAskedOfNewFiles() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.putOld(QStringLiteral("b-400 to 600 HU.stl")));
  QVERIFY(w.saveSurfaces(QStringLiteral("a.stl")));
  QVERIFY(!w.question());
  QCOMPARE(w.files(), QStringList({secondStl, firstStl, QStringLiteral("b-400 to 600 HU.stl")}));
  QVERIFY(w.isOld(QStringLiteral("b-400 to 600 HU.stl")));
}

// The exported segments are not those of another series shown while the file dialog is open. That series has
// none.
void TestSegmentExport::theSegmentsAreThoseOfWhenItWasAsked() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  w.child<QAction>("exportSegments")->trigger();
  w.session().show(ballSeries(16, 5));
  answer(w, "segmentDialog", w.at(QStringLiteral("a.seg.nrrd")));
  QTRY_COMPARE_WITH_TIMEOUT(w.files(), QStringList({QStringLiteral("a.seg.nrrd")}), longest);
  QFile file(w.at(QStringLiteral("a.seg.nrrd")));
  QVERIFY(file.open(QIODevice::ReadOnly));
  QVERIFY(file.readAll().contains("800 to 1200 HU"));
}

void TestSegmentExport::surfacesAreToldBeforeTheyAreSaved() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  w.startExport(QStringLiteral("a.stl"));
  QVERIFY(w.areMade());
  QCOMPARE(w.files(), QStringList());
  QCOMPARE(w.table()->columnCount(), 6);
  QCOMPARE(w.column(0), QStringList({QStringLiteral("800 to 1200 HU"), QStringLiteral("400 to 600 HU")}));
  const QString coreMl = digitsText(double(voxelsWhere(isCore)) / 1000, 4);
  QCOMPARE(w.column(2)[1], coreMl);
  const double insideMl = w.column(3)[1].toDouble(), areaCm2 = w.column(4)[1].toDouble();
  QVERIFY(std::abs(insideMl / coreMl.toDouble() - 1) < 0.2);
  // No body of this volume has less surface than a ball.
  QVERIFY(areaCm2 > 4.8 * std::pow(insideMl, 2.0 / 3) && areaCm2 < 6 * std::pow(insideMl, 2.0 / 3));
  const QStringList triangles = w.column(1);
  QVERIFY(w.press("surfaceSave"));
  QCOMPARE(QStringList({w.trianglesOf(firstStl), w.trianglesOf(secondStl)}), triangles);
}

void TestSegmentExport::surfacesAreReduced() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  w.startExport(QStringLiteral("a.stl"));
  QVERIFY(w.areMade());
  const QStringList all = w.column(1), insideMl = w.column(3);
  w.reduceBy("0.5");
  QVERIFY(!w.button("surfaceSave")->isEnabled());
  QVERIFY(w.areMade());
  QCOMPARE(w.table()->columnCount(), 9);
  QCOMPARE(w.column(5), all);
  QCOMPARE(w.column(6), insideMl);
  const QStringList fewer = w.column(1);
  for (const int row : {0, 1}) {
    QVERIFY(fewer[row].toInt() > 10 && fewer[row].toInt() < all[row].toInt() / 2);
    QVERIFY(w.column(7)[row].toDouble() > 0 && w.column(7)[row].toDouble() < 1);
  }
  QVERIFY(w.press("surfaceSave"));
  QCOMPARE(QStringList({w.trianglesOf(firstStl), w.trianglesOf(secondStl)}), fewer);
}

// The first segment is a shell around the core, and a separate small ball.
void TestSegmentExport::theLargestPartAlone() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  w.startExport(QStringLiteral("a.stl"));
  QVERIFY(w.areMade());
  QCOMPARE(w.column(5), QStringList({QStringLiteral("3"), QStringLiteral("1")}));
  w.click("surfaceLargest");
  QVERIFY(w.areMade());
  QCOMPARE(w.column(5), QStringList({QStringLiteral("2"), QStringLiteral("1")}));
  QCOMPARE(w.column(2)[0], digitsText(double(voxelsWhere(isShell)) / 1000, 4));
  const QStringList triangles = w.column(1);
  QVERIFY(w.press("surfaceSave"));
  QCOMPARE(QStringList({w.trianglesOf(firstStl), w.trianglesOf(secondStl)}), triangles);
}

// Existing files of single segments stay unchanged.
void TestSegmentExport::allSurfacesStandInOneFile() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY(w.putOld(secondStl));
  w.startExport(QStringLiteral("a.stl"));
  QVERIFY(w.areMade());
  QTest::keyClick(w.child<QComboBox>("surfaceFiles"), Qt::Key_Down);
  const QStringList triangles = w.column(1);
  QVERIFY(w.press("surfaceSave"));
  QVERIFY(!w.question());
  QCOMPARE(w.files(), QStringList({secondStl, QStringLiteral("a.stl")}));
  QVERIFY(w.isOld(secondStl));
  QCOMPARE(w.trianglesOf(QStringLiteral("a.stl")).toInt(), triangles[0].toInt() + triangles[1].toInt());
}

void TestSegmentExport::nothingIsWrittenWhereItIsCancelled() {
  ExportWindow w;
  QVERIFY(w.makeBoth());
  w.startExport(QStringLiteral("a.stl"));
  auto* dialog = w.child<QDialog>("surfaceDialog");
  QVERIFY(dialog);
  QTest::keyClick(dialog, Qt::Key_Escape);
  QTRY_VERIFY_WITH_TIMEOUT(!w.child<QDialog>("surfaceDialog"), longest);
  QVERIFY(w.idle());
  QCOMPARE(w.files(), QStringList());
}

VOLUMEN_TEST(TestSegmentExport);
#include "tst_segment_export.moc"
