// Guards design.md 8: snapshots have the chosen settings and show the series for which they were requested.
// Messages appear meanwhile.
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QFileDialog>
#include <QImageReader>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "io/files/scene_file.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using volumen::tests::answer;
using volumen::tests::Journey;
using volumen::tests::longest;

namespace {

const QStringList head{QStringLiteral("phantom:ct-head:48")};

void choose(Journey& w, const char* combo, int index) { w.child<QComboBox>(combo)->setCurrentIndex(index); }

void setSize(Journey& w, int width, int height) {
  w.child<QSpinBox>("snapshotWidth")->setValue(width);
  w.child<QSpinBox>("snapshotHeight")->setValue(height);
}

void ask(Journey& w, const QString& path) {
  w.child<QAction>("snapshot")->trigger();
  answer(w, "snapshotDialog", path);
}

// Returns the file's image once the file exists.
QImage taken(Journey& w, const QString& path) {
  ask(w, path);
  return QTest::qWaitFor([&] { return QFile::exists(path); }, longest) ? QImage(path) : QImage();
}

// Returns where two pictures of one size differ.
QRect difference(const QImage& a, const QImage& b) {
  QRect where;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      if (a.pixel(x, y) != b.pixel(x, y)) where |= QRect(x, y, 1, 1);
  return where;
}

}  // namespace

class TestSnapshots : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsWrittenOverItIsChosen_data();
  void whatIsWrittenOverItIsChosen();
  void theBackgroundIsChosen_data();
  void theBackgroundIsChosen();
  void aJpegHoldsTheSceneAsWell();
  void jpegCannotBeTransparent();
  void aCopyGoesToTheClipboard();
  void aTurntableIsPicturesOfAFullTurn();
  void howFarItIsIsToldAndItCanBeCancelled();
  void itIsOfTheSeriesItWasAskedOf();
  void noTurntableReplacesAnother();
  void withoutASeriesThereIsASentence();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QTemporaryDir folder_;
};

void TestSnapshots::whatIsWrittenOverItIsChosen_data() {
  QTest::addColumn<QString>("box");
  QTest::addColumn<QRect>("within");  // of 400 x 400 pixels
  QTest::addColumn<QRect>("covers");
  const auto row = [](const char* box, QRect within, QRect covers) {
    QTest::newRow(box) << QString::fromLatin1(box) << within << covers;
  };
  row("snapshotLetters", {0, 0, 400, 400}, {15, 20, 360, 330});
  row("snapshotScaleBar", {100, 350, 200, 50}, {180, 385, 40, 3});
  row("snapshotPatient", {0, 0, 200, 60}, {15, 15, 30, 10});
  row("snapshotWarnings", {0, 0, 200, 60}, {15, 13, 45, 6});
}

void TestSnapshots::whatIsWrittenOverItIsChosen() {
  QFETCH(QString, box);
  QFETCH(QRect, within);
  QFETCH(QRect, covers);
  Journey w(head);
  QVERIFY(w.settle());
  // Shows a series with a patient and a warning.
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->warnings = {{"Gantry tilt of 18.5 degrees, corrected in 3D.", WarningKind::sheared}};
  w.after([&] { w.window.session().show(series); });
  setSize(w, 400, 400);
  w.child<QCheckBox>("snapshotWarnings")->setChecked(false);
  const QImage plain = taken(w, at(box + QStringLiteral("-plain.png")));
  w.child<QCheckBox>(qPrintable(box))->click();
  const QImage with = taken(w, at(box + QStringLiteral("-with.png")));
  const QRect where = difference(plain, with);
  QVERIFY2(within.contains(where) && where.contains(covers), qPrintable(QStringLiteral("%1 %2 %3 %4")
                                                                            .arg(where.x())
                                                                            .arg(where.y())
                                                                            .arg(where.width())
                                                                            .arg(where.height())));
  // Warnings about the picture are in its metadata in any case.
  for (const QImage& image : {plain, with})
    QCOMPARE(image.text(QStringLiteral("volumen-warnings")),
             QStringLiteral("sheared: Gantry tilt of 18.5 degrees, corrected in 3D."));
}

void TestSnapshots::theBackgroundIsChosen_data() {
  QTest::addColumn<int>("choice");
  QTest::addColumn<QRgb>("corner");
  QTest::newRow("as in the view") << 0 << qRgba(0, 0, 0, 255);
  QTest::newRow("black") << 1 << qRgba(0, 0, 0, 255);
  QTest::newRow("white") << 2 << qRgba(255, 255, 255, 255);
  QTest::newRow("grey") << 3 << qRgba(128, 128, 128, 255);
  QTest::newRow("transparent") << 4 << qRgba(0, 0, 0, 0);
}

void TestSnapshots::theBackgroundIsChosen() {
  QFETCH(int, choice);
  QFETCH(QRgb, corner);
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 60, 50);
  choose(w, "snapshotBackground", choice);
  const QImage image = taken(w, at(QStringLiteral("background-%1.png").arg(choice)));
  QCOMPARE(image.size(), QSize(60, 50));
  QCOMPARE(image.pixel(0, 0), corner);
  QVERIFY2(qAlpha(image.pixel(30, 25)) > 200, "the head is not transparent");
}

void TestSnapshots::aJpegHoldsTheSceneAsWell() {
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 120, 100);
  choose(w, "snapshotFormat", 1);
  choose(w, "snapshotBackground", 2);
  const QString path = at(QStringLiteral("head.jpg"));
  const QImage image = taken(w, path);
  QCOMPARE(QImageReader(path).format(), QByteArray("jpeg"));
  QVERIFY(qGray(image.pixel(0, 0)) > 245);
  const auto scene = sceneText(path.toStdString());
  QVERIFY2(scene.ok() && scene->find("transferFunction") != std::string::npos, "to be opened again");
}

void TestSnapshots::jpegCannotBeTransparent() {
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 30, 30);
  choose(w, "snapshotFormat", 1);
  choose(w, "snapshotBackground", 4);
  QCOMPARE(w.child<QComboBox>("snapshotFormat")->currentText(), QStringLiteral("PNG"));
  // The file name may still choose a format.
  const QString path = at(QStringLiteral("clear.jpg"));
  ask(w, path);
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY(banner->sentence().contains(path) && banner->sentence().contains(QStringLiteral("transparent")));
  QVERIFY(!QFile::exists(path));
}

void TestSnapshots::aCopyGoesToTheClipboard() {
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 70, 40);
  choose(w, "snapshotQuality", 0);
  const QImage file = taken(w, at(QStringLiteral("copied.png")));
  QApplication::clipboard()->clear();
  QTest::mouseClick(w.child<QWidget>("snapshotCopy"), Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(!QApplication::clipboard()->image().isNull(), longest);
  const QImage copied = QApplication::clipboard()->image();
  QVERIFY(copied.convertToFormat(QImage::Format_RGB32) == file.convertToFormat(QImage::Format_RGB32));
}

void TestSnapshots::aTurntableIsPicturesOfAFullTurn() {
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 48, 48);
  choose(w, "snapshotQuality", 0);
  const QImage front = taken(w, at(QStringLiteral("front.png")));
  const QDir folder(at(QStringLiteral("turn")));
  QVERIFY(folder.mkpath(QStringLiteral(".")));
  w.child<QSpinBox>("turntablePictures")->setValue(4);
  QTest::mouseClick(w.child<QWidget>("turntableSave"), Qt::LeftButton);
  answer(w, "turntableDialog", folder.path());
  QTRY_COMPARE_WITH_TIMEOUT(folder.entryList({QStringLiteral("*-00?.png")}).size(), 4, longest);
  QList<QImage> pictures;
  for (const QString& name : folder.entryList({QStringLiteral("*.png")}, QDir::NoFilter, QDir::Name))
    pictures << QImage(folder.filePath(name));
  QVERIFY2(pictures[0] == front, "it begins with what is seen");
  for (int n = 1; n < 4; ++n) QVERIFY(pictures[n] != pictures[n - 1]);
}

void TestSnapshots::howFarItIsIsToldAndItCanBeCancelled() {
  Journey w({QStringLiteral("phantom:ct-head:128")});
  QVERIFY(w.settle());
  setSize(w, 3000, 3000);
  choose(w, "snapshotQuality", 2);
  const QString path = at(QStringLiteral("large.png"));
  ask(w, path);
  auto* text = w.child<QLabel>("taskText");
  const QRegularExpression told(QStringLiteral("^Rendering snapshot: \\d+ %, \\d+ (s|min) left$"));
  QTRY_VERIFY_WITH_TIMEOUT(told.match(text->text()).hasMatch(), longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  w.shot("progress");
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QCOMPARE(banner->sentence(), QStringLiteral("Cancelled."));
  QVERIFY(!QFile::exists(path));
}

void TestSnapshots::itIsOfTheSeriesItWasAskedOf() {
  Journey w({QStringLiteral("phantom:cube:32"), QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto found = [&] {
    return tree->findItems(QStringLiteral("sphere"), Qt::MatchContains | Qt::MatchRecursive).value(0);
  };
  QTRY_VERIFY_WITH_TIMEOUT(found(), longest);
  setSize(w, 700, 700);
  const QImage before = taken(w, at(QStringLiteral("before.png")));
  // Another series is shown while the snapshots are drawn.
  for (int n = 0; n < 3; ++n) ask(w, at(QStringLiteral("cube-%1.png").arg(n)));
  QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualItemRect(found()).center());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("sphere")), longest);
  for (int n = 0; n < 3; ++n) {
    const QString path = at(QStringLiteral("cube-%1.png").arg(n));
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
    QVERIFY(QImage(path) == before);
  }
  const QImage after = taken(w, at(QStringLiteral("sphere.png")));
  QVERIFY(!after.isNull() && after != before);
}

// File names are those of series, which another patient's may share. The second of two simultaneous requests
// gets its own number, and existing files stay.
void TestSnapshots::noTurntableReplacesAnother() {
  Journey w(head);
  QVERIFY(w.settle());
  setSize(w, 24, 24);
  choose(w, "snapshotQuality", 0);
  const QDir folder(at(QStringLiteral("kept")));
  QVERIFY(folder.mkpath(QStringLiteral(".")));
  w.child<QSpinBox>("turntablePictures")->setValue(2);
  const auto turn = [&] {
    QTest::mouseClick(w.child<QWidget>("turntableSave"), Qt::LeftButton);
    answer(w, "turntableDialog", folder.path());
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  };
  const auto names = [&] { return folder.entryList({QStringLiteral("*.png")}, QDir::NoFilter, QDir::Name); };
  turn();
  QTRY_COMPARE_WITH_TIMEOUT(names().size(), 2, longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.jobs().rows().empty(), longest);
  const QString last = folder.filePath(names().at(1));
  QVERIFY(QFile::remove(last));
  QFile other(last);
  QVERIFY(other.open(QIODevice::WriteOnly) && other.write("another patient's") > 0);
  other.close();
  turn(), turn();
  QTRY_COMPARE_WITH_TIMEOUT(names().size(), 6, longest);
  QCOMPARE(names().filter(QStringLiteral(" (2)-00")).size(), 2);
  QCOMPARE(names().filter(QStringLiteral(" (3)-00")).size(), 2);
  QVERIFY(other.open(QIODevice::ReadOnly));
  QCOMPARE(other.readAll(), QByteArray("another patient's"));
}

void TestSnapshots::withoutASeriesThereIsASentence() {
  Journey w;
  for (const char* action : {"copySnapshot", "openScene", "saveScene"}) {
    w.child<Banner>("banner")->hide();
    w.child<QAction>(action)->trigger();
    QCOMPARE(w.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
    QVERIFY(w.child<Banner>("banner")->isVisible());
  }
}

VOLUMEN_TEST(TestSnapshots);
#include "tst_snapshots.moc"
