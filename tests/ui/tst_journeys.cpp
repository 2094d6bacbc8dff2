// Guards design.md 8: complete workflows through the window, by real events.
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QMimeData>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/curve_editor.h"
#include "ui/widgets/light_ball.h"

using namespace volumen;
using volumen::tests::Journey;
using volumen::tests::longest;

namespace {

double meanBrightness(const QImage& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += qGray(image.pixel(x, y));
  return sum / (double(image.width()) * image.height());
}

const QStringList sample{QStringLiteral("phantom:ct-head:64")};

}  // namespace

class TestJourneys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theSampleStudyIsShown();
  void curvePointAndLightAreDraggedAndUndone();
  void snapshotIsSavedAndReadBack();
  void snapshotOfAnySizeWithTransparentBackground();
  void presetsAndPanelsChangeThePicture();
  void whatIsVisibleIsSegmentedShownAloneAndSaved();
  void aClickOnASeriesShowsIt();
  void severalPathsAreOpenedAtOnce();
  void droppedFilesAreOpened();
  void whatCannotBeOpenedIsSaidInASentence_data();
  void whatCannotBeOpenedIsSaidInASentence();
  void everyPathIsComplainedAbout();
  void closingWhileRenderingIsClean_data();
  void closingWhileRenderingIsClean();
  void viewAloneAndBack();
};

void TestJourneys::theSampleStudyIsShown() {
  Journey w;
  w.shot("start");
  QVERIFY(w.child<QWidget>("startPage")->isVisible());
  w.window.open(sample);
  QVERIFY(w.settle());
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("ct-head")));
  QVERIFY(w.window.windowTitle().endsWith(QStringLiteral(" - volumen")));
  QVERIFY(w.window.view()->isVisible());
  // A panel that is filled later may narrow the view once more.
  QTRY_COMPARE_WITH_TIMEOUT(w.window.view()->picture().size(), w.window.view()->pixels(), longest);
  QVERIFY2(meanBrightness(w.window.view()->picture()) > 10, "something is seen");
  QVERIFY(w.child<QTextBrowser>("effectsPanel")->toPlainText().contains(QStringLiteral("gradients")));
  w.shot("head");
}

void TestJourneys::curvePointAndLightAreDraggedAndUndone() {
  Journey w(sample);
  QVERIFY(w.settle());
  const QImage first = w.window.view()->picture();
  const Scene start = w.window.session().scene();
  auto* editor = w.child<CurveEditor>("curveEditor");
  auto* ball = w.child<LightBall>("lightBall");

  // Lowering the curve's highest point to zero shows less.
  int highest = 0;
  for (int n = 0; n < int(start.transferFunction.points.size()); ++n)
    if (start.transferFunction.points[n].opacity > start.transferFunction.points[highest].opacity)
      highest = n;
  const QPointF from = editor->positionOf(highest), ground(from.x(), editor->opacityAxis().pixelZero);
  const QImage thinner = w.after([&] { tests::drag(editor, from, ground); });
  QVERIFY2(thinner != first, "the picture follows the curve");
  QVERIFY2(meanBrightness(thinner) < meanBrightness(first), "less opacity on black: darker");

  // Moving the first light to the far side darkens the picture.
  const glm::dvec3 direction = ball->lights()[0].direction;
  const QPointF at = ball->positionOf(direction);
  const QImage unlit = w.after([&] { QTest::mouseDClick(ball, Qt::LeftButton, {}, at.toPoint()); });
  QVERIFY2(meanBrightness(unlit) < meanBrightness(thinner), "a light behind leaves the front dark");
  const QImage side = w.after([&] { tests::drag(ball, at, ball->positionOf({-0.6, 0.5, -0.62})); });
  QVERIFY(side != unlit);

  QCOMPARE(w.window.session().undoStack().count(), 3);
  w.after("undo");
  const QImage lightBack = w.after("undo");
  QVERIFY2(lightBack == thinner, "the light undone: the picture before it, to the byte");
  const QImage curveBack = w.after("undo");
  QVERIFY2(curveBack == first, "the curve undone: the first picture, to the byte");
  QVERIFY(w.window.session().scene() == start);
  QVERIFY(w.after("redo") == thinner);
}

void TestJourneys::snapshotIsSavedAndReadBack() {
  Journey w(sample);
  QVERIFY(w.settle());
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("head.png"));
  w.child<QComboBox>("snapshotQuality")->setCurrentIndex(0);
  w.child<QAction>("snapshot")->trigger();
  answer(w, "snapshotDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  // The saved standard picture of the view's size equals the picture in the view.
  const QImage saved = QImage(path).convertToFormat(QImage::Format_RGB32);
  const QImage seen = w.window.view()->picture();
  QCOMPARE(saved.size(), seen.size());
  QVERIFY(saved == seen);
  QVERIFY(QImage(path).text(QStringLiteral("volumen-scene")).contains(QStringLiteral("volumenScene")));
}

void TestJourneys::snapshotOfAnySizeWithTransparentBackground() {
  Journey w(sample);
  QVERIFY(w.settle());
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("small.png"));
  w.child<QSpinBox>("snapshotWidth")->setValue(123);
  w.child<QSpinBox>("snapshotHeight")->setValue(77);
  w.child<QComboBox>("snapshotBackground")->setCurrentIndex(4);
  w.child<QAction>("snapshot")->trigger();
  answer(w, "snapshotDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  const QImage saved(path);
  QCOMPARE(saved.size(), QSize(123, 77));
  QCOMPARE(qAlpha(saved.pixel(0, 0)), 0);
  QVERIFY(qAlpha(saved.pixel(61, 38)) > 0);
}

void TestJourneys::presetsAndPanelsChangeThePicture() {
  Journey w(sample);
  QVERIFY(w.settle());
  const QImage first = w.window.view()->picture();
  auto* presets = w.child<QComboBox>("presets");
  QVERIFY(presets->count() > 5);
  const int bone = presets->findText(QStringLiteral("Bone"), Qt::MatchContains);
  QVERIFY(bone > 0);
  const QImage other = w.after([&] {
    presets->setCurrentIndex(bone);
    Q_EMIT presets->activated(bone);
  });
  QVERIFY(other != first);
  QVERIFY(w.after("undo") == first);
  // Switches lighting off, then sets a clip box that leaves nothing.
  QVERIFY(w.after([&] { w.child<QCheckBox>("lit")->click(); }) != first);
  auto* clip = w.child<QWidget>("clipHigh2")->findChild<QDoubleSpinBox*>();
  const QImage clipped = w.after([&] { clip->setValue(0); });
  QCOMPARE(meanBrightness(clipped), 0.0);
  w.after("undo");
  QVERIFY(w.after("undo") == first);
  // The other projection keeps the size and draws no scale bar.
  auto* projection = w.child<QComboBox>("projection");
  QVERIFY(w.after([&] { projection->setCurrentIndex(1); }) != first);
  w.shot("perspective");
}

void TestJourneys::whatIsVisibleIsSegmentedShownAloneAndSaved() {
  Journey w({QStringLiteral("phantom:sphere")});
  QVERIFY(w.settle());
  // The ball of value 1 has as many voxels as there are centres inside radius 32.
  w.child<QDoubleSpinBox>("segmentLow")->setValue(0.5);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1);
  const QImage first = w.after([&] { QTest::mouseClick(w.child<QWidget>("segment"), Qt::LeftButton); });
  QCOMPARE(w.window.document().drawn.segments(sceneViewId).size(), std::size_t(1));
  auto* only = w.child<QCheckBox>("segmentOnly");
  QTRY_VERIFY_WITH_TIMEOUT(only->isEnabled(), longest);
  const Volume& volume = *w.window.session().series()->volume;
  std::int64_t voxels = 0;
  for (std::int64_t n = 0; n < volume.geometry().voxelCount(); ++n) voxels += volume.valueAt(n) == 1;
  const auto* result = w.child<QLabel>("segmentResult");
  QTRY_COMPARE_WITH_TIMEOUT(result->text(),
                            QStringLiteral("%1 ml, mean 1.000 (%2 voxels)")
                                .arg(double(voxels) / 1000, 0, 'f', 0)
                                .arg(QLocale().toString(qlonglong(voxels))),
                            longest);

  const QImage alone = w.after([&] { only->click(); });
  QVERIFY(alone != first);
  QVERIFY(only->isChecked());
  QVERIFY(w.after("undo") == first);
  QVERIFY2(!only->isChecked(), "the toggle follows undo");

  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("ball.seg.nrrd"));
  w.child<QAbstractButton>("segmentSave")->click();
  answer(w, "segmentDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
}

void TestJourneys::aClickOnASeriesShowsIt() {
  Journey w(sample);
  QVERIFY(w.settle());
  w.window.open({QStringLiteral("phantom:sphere")});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("sphere")), longest);
  auto* tree = w.child<QTreeWidget>("studyTree");
  QTreeWidgetItem* head =
      tree->findItems(QStringLiteral("ct-head"), Qt::MatchContains | Qt::MatchRecursive).value(0);
  QVERIFY(head);
  QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualItemRect(head).center());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("ct-head")), longest);
  w.child<QAction>("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("sphere")), longest);
}

void TestJourneys::severalPathsAreOpenedAtOnce() {
  Journey w({QStringLiteral("phantom:sphere:32"), QStringLiteral("phantom:cube:16")});
  QVERIFY(w.settle());
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("sphere")));
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto inTree = [&](const QString& name) {
    return !tree->findItems(name, Qt::MatchContains | Qt::MatchRecursive).isEmpty();
  };
  QTRY_VERIFY_WITH_TIMEOUT(inTree(QStringLiteral("sphere")) && inTree(QStringLiteral("cube")), longest);
}

void TestJourneys::droppedFilesAreOpened() {
  const QTemporaryDir folder;
  Journey w;
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(folder.path())});
  QVERIFY(tests::drop(data, &w.window));
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY(banner->sentence().contains(folder.path()));
}

void TestJourneys::whatCannotBeOpenedIsSaidInASentence_data() {
  QTest::addColumn<QString>("what");
  QTest::newRow("missing path") << QStringLiteral("missing");
  QTest::newRow("folder without images") << QStringLiteral("folder");
  QTest::newRow("text file") << QStringLiteral("file");
  QTest::newRow("unknown phantom") << QStringLiteral("phantom:nonsense");
}

void TestJourneys::whatCannotBeOpenedIsSaidInASentence() {
  QFETCH(QString, what);
  const QTemporaryDir folder;
  QFile text(folder.filePath(QStringLiteral("notes.txt")));
  QVERIFY(text.open(QIODevice::WriteOnly));
  text.write("no image\n");
  text.close();
  QString path = what;
  if (what == QStringLiteral("missing")) path = folder.filePath(QStringLiteral("nowhere"));
  if (what == QStringLiteral("folder")) path = folder.path();
  if (what == QStringLiteral("file")) path = text.fileName();
  Journey w({path});
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  const QString name = what.startsWith(QStringLiteral("phantom")) ? QStringLiteral("nonsense") : path;
  QVERIFY2(banner->sentence().contains(name), qPrintable(banner->sentence()));
  QVERIFY2(banner->sentence().endsWith(QLatin1Char('.')), qPrintable(banner->sentence()));
  QVERIFY(w.child<QWidget>("startPage")->isVisible());
  w.shot("missing");
}

void TestJourneys::everyPathIsComplainedAbout() {
  const QTemporaryDir folder;
  QDir(folder.path()).mkdir(QStringLiteral("empty"));
  const QString texts = folder.filePath(QStringLiteral("texts"));
  QDir(folder.path()).mkdir(QStringLiteral("texts"));
  constexpr int count = 40;
  for (int n = 0; n < count; ++n) {
    QFile text(texts + QStringLiteral("/%1.txt").arg(n));
    QVERIFY(text.open(QIODevice::WriteOnly));
    text.write("words");
  }
  const QStringList paths{folder.filePath(QStringLiteral("nowhere")),
                          folder.filePath(QStringLiteral("empty")), texts};
  Journey w(paths);
  auto* banner = w.child<Banner>("banner");
  const auto saysAll = [&] {
    return std::all_of(paths.begin(), paths.end(),
                       [&](const QString& path) { return banner->sentence().contains(path); });
  };
  QTRY_VERIFY_WITH_TIMEOUT(saysAll(), longest);
  QCOMPARE(banner->sentence().count(QLatin1Char('\n')), 2);
  // The details list every file with its reason.
  QTest::mouseClick(banner->findChild<QToolButton*>(), Qt::LeftButton);
  auto* details = w.child<QPlainTextEdit>("bannerDetails");
  QVERIFY(details->isVisible());
  QCOMPARE(details->toPlainText().count(QStringLiteral("not an image")), count);
  w.shot("complaints");
  // Paths often contain names. They are hidden with the names, and come back.
  w.child<QAction>("hideNames")->trigger();
  QVERIFY2(!banner->sentence().contains(folder.path()), qPrintable(banner->sentence()));
  QVERIFY(!details->toPlainText().contains(folder.path()));
  QCOMPARE(details->toPlainText().count(QStringLiteral("not an image")), count);
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(saysAll() && details->toPlainText().contains(texts));
}

void TestJourneys::closingWhileRenderingIsClean_data() {
  QTest::addColumn<int>("afterMs");
  for (int ms : {0, 5, 50, 150, 400}) QTest::addRow("after %d ms", ms) << ms;
}

void TestJourneys::closingWhileRenderingIsClean() {
  QFETCH(int, afterMs);
  Journey w(sample);
  QTest::qWait(afterMs);
  if (w.window.session().series())
    w.window.session().edit(QStringLiteral("turn"), [](Scene& s) { s.shading.ambient = 0.5; });
  QVERIFY(w.window.close());
}

void TestJourneys::viewAloneAndBack() {
  Journey w(sample);
  QVERIFY(w.settle());
  const int width = w.window.view()->width();
  w.after([&] { QTest::mouseDClick(w.window.view(), Qt::LeftButton, {}, QPoint(100, 200)); });
  QVERIFY(w.window.view()->width() > width + 200);
  w.shot("alone");
  w.after([&] { QTest::mouseDClick(w.window.view(), Qt::LeftButton, {}, QPoint(100, 200)); });
  QCOMPARE(w.window.view()->width(), width);
}

VOLUMEN_TEST(TestJourneys);
#include "tst_journeys.moc"
