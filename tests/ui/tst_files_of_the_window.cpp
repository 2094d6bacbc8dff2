// Guards design.md 8: scenes are saved and opened, recent files are offered, and warnings such as missing
// spacing stand on the picture.
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>

#include "io/files/picture_file.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/journey.h"
#include "tests/ui/scene_session.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using volumen::tests::answer;
using volumen::tests::Journey;
using volumen::tests::longest;

namespace {

const QStringList ball{QStringLiteral("phantom:sphere:32")};

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(bytes);
}

// A volume without spacing.
const QByteArray uncalibrated =
    "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, '\x7f');

}  // namespace

class TestFilesOfTheWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { QSettings().remove(QStringLiteral("recent")); }
  void aSceneIsSavedAndOpened();
  void aWrongSceneIsASentence_data();
  void aWrongSceneIsASentence();
  void aSceneGivenAtTheStartIsShown();
  void recentFilesAreOffered();
  void warningsStandOnThePicture_data();
  void warningsStandOnThePicture();
  void aTiltedStudySaysSo();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  QTemporaryDir folder_;
};

void TestFilesOfTheWindow::aSceneIsSavedAndOpened() {
  Journey w(ball);
  QVERIFY(w.settle());
  const QImage first = w.window.view()->picture();
  w.child<QAction>("saveScene")->trigger();
  answer(w, "saveSceneDialog", at("scene.json"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(at("scene.json")), longest);
  // Opens the scene from a PNG of it, too.
  w.child<QAction>("snapshot")->trigger();
  answer(w, "snapshotDialog", at("scene.png"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(at("scene.png")), longest);
  for (const char* name : {"scene.json", "scene.png"}) {
    const QImage turned = w.after([&] { QTest::keyClick(w.window.view(), Qt::Key_Right); });
    const QImage lit = w.after(
        [&] { w.window.session().edit(QStringLiteral("dark"), [](Scene& s) { s.shading.ambient = 0.9; }); });
    QVERIFY(turned != first && lit != turned);
    const int steps = w.window.session().undoStack().count();
    const QImage back = w.after([&] {
      w.child<QAction>("openScene")->trigger();
      answer(w, "openSceneDialog", at(name));
    });
    QVERIFY2(back == first, name);
    QCOMPARE(w.window.session().undoStack().count(), steps + 1);
    QVERIFY(w.after("undo") == lit);
    QVERIFY(w.after([&] {
      while (w.window.session().undoStack().canUndo()) w.window.session().undoStack().undo();
    }) == first);
  }
}

void TestFilesOfTheWindow::aWrongSceneIsASentence_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("why");
  QTest::newRow("not JSON") << QByteArray("hello") << QStringLiteral("JSON");
  QTest::newRow("no scene") << QByteArray("{\"a\": 1}") << QStringLiteral("volumenScene");
  QTest::newRow("a value out of range")
      << QByteArray("{\"volumenScene\": 1, \"lights\": [{\"intensity\": -1}]}")
      << QStringLiteral("lights[0].intensity");
  QTest::newRow("a picture of another program") << QByteArray() << QStringLiteral("holds no scene");
}

void TestFilesOfTheWindow::aWrongSceneIsASentence() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, why);
  const QString path = at("wrong");
  if (bytes.isEmpty())
    QVERIFY(QImage(3, 3, QImage::Format_Grayscale8).save(path, "PNG"));
  else
    write(path, bytes);
  Journey w(ball);
  QVERIFY(w.settle());
  const Scene before = w.window.session().scene();
  w.child<QAction>("openScene")->trigger();
  answer(w, "openSceneDialog", path);
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY2(banner->sentence().contains(path) && banner->sentence().contains(why),
           qPrintable(banner->sentence()));
  QVERIFY(w.window.session().scene() == before);
  QVERIFY(!w.window.session().undoStack().canUndo());
}

void TestFilesOfTheWindow::aSceneGivenAtTheStartIsShown() {
  Scene scene;
  scene.camera = Camera{.target = glm::dvec3(0), .height = 77};
  scene.background.colour = {0, 0, 1};
  Journey w;
  w.window.open(ball, scene);
  QVERIFY(w.settle());
  QVERIFY(w.window.session().scene() == scene);
  QCOMPARE(w.window.view()->picture().pixel(0, 0), qRgb(0, 0, 255));
  w.after("undo");
  QVERIFY2(w.window.session().scene() == w.window.session().series()->firstScene, "one step back");
  // The scene applies only to the first series that it opens.
  w.window.open({QStringLiteral("phantom:cube:16")});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("cube")), longest);
  QVERIFY(w.window.session().scene() == w.window.session().series()->firstScene);
}

void TestFilesOfTheWindow::recentFilesAreOffered() {
  const QString kept = at("kept.nrrd"), gone = at("gone.nrrd");
  for (const QString& path : {kept, gone}) write(path, uncalibrated);
  {
    Journey w({gone});
    QVERIFY(w.settle());
    QVERIFY(w.after([&] { w.window.open({kept}); }) != QImage());
    w.window.open(ball);
    QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("sphere")), longest);
  }
  QVERIFY(QFile::remove(gone));
  Journey w;
  const auto buttons = [&] { return w.window.findChildren<QPushButton*>(QStringLiteral("recent")); };
  QTRY_VERIFY_WITH_TIMEOUT(buttons().size() == 2 && !buttons()[1]->isEnabled(), longest);
  QVERIFY2(buttons()[0]->toolTip().contains(kept) && buttons()[1]->toolTip().contains(gone),
           "the latest first");
  QTRY_VERIFY(buttons()[0]->isVisible());
  QVERIFY(buttons()[0]->isEnabled());
  w.shot("recent");
  QTest::mouseClick(buttons()[0], Qt::LeftButton);
  QVERIFY(w.settle());
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("kept")));
  // The menu lists the same files. Once cleared, it is empty here and in the settings.
  QAction* clear = w.child<QAction>("clearRecentMenu");
  auto* menu = qobject_cast<QMenu*>(clear->parent());
  QVERIFY(menu->actions()[0]->text() == kept && menu->actions()[0]->isEnabled());
  QVERIFY(menu->actions()[1]->text() == gone && !menu->actions()[1]->isEnabled());
  clear->trigger();
  QTRY_VERIFY(!menu->isEnabled());
  QVERIFY(QSettings().value(QStringLiteral("recent")).toStringList().isEmpty());
}

void TestFilesOfTheWindow::warningsStandOnThePicture_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<QString>("words");
  QTest::newRow("missing") << int(WarningKind::missingSlices) << QStringLiteral("! Slices missing");
  QTest::newRow("interpolated") << int(WarningKind::unevenSlices) << QStringLiteral("! Slices interpolated");
  QTest::newRow("sheared") << int(WarningKind::sheared) << QStringLiteral("! Gantry tilt");
  QTest::newRow("beside the line") << int(WarningKind::offLine) << QStringLiteral("! Slice displaced");
  QTest::newRow("no directions") << int(WarningKind::noDirections)
                                 << QStringLiteral("! Directions not known");
  QTest::newRow("not calibrated") << int(WarningKind::notCalibrated) << QStringLiteral("! Not calibrated");
  QTest::newRow("nothing that changes the picture") << int(WarningKind::other) << QString();
}

void TestFilesOfTheWindow::warningsStandOnThePicture() {
  QFETCH(int, kind);
  QFETCH(QString, words);
  tests::SceneSession s;
  Session& session = s.session;
  VolumeView view(session, s.scenes, s.drawService);
  view.resize(400, 300);
  view.show();
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->warnings = {Warning("a.dcm is a copy of b.dcm and is left out."),
                      {"Something with <mm> in it.", WarningKind(kind)}};
  session.show(series);
  auto* badge = view.findChild<QLabel*>(QStringLiteral("warningBadge"));
  QVERIFY(badge);
  QCOMPARE(badge->isVisible(), !words.isEmpty());
  QCOMPARE(badge->text(), words);
  if (words.isEmpty()) return;
  QVERIFY(view.rect().contains(badge->geometry()));
  QVERIFY(badge->toolTip().contains(QStringLiteral("Something with &lt;mm&gt; in it.")));
  QVERIFY2(!badge->toolTip().contains(QStringLiteral("copy")), "what changes nothing is not among them");
  session.show(tests::ballSeries());
  QVERIFY2(!badge->isVisible(), "it goes with its series");
}

void TestFilesOfTheWindow::aTiltedStudySaysSo() {
  const std::string path = tests::dataPath("dicom-geometry/ct-ge-tilt-varspacing-28");
  NEED_DATA(path);
  Journey w({QString::fromStdString(path)});
  QVERIFY(w.settle());
  auto* badge = w.child<QLabel>("warningBadge");
  QVERIFY(badge->isVisible());
  QCOMPARE(badge->text(), QStringLiteral("! Gantry tilt\n! Slices interpolated"));
  QVERIFY2(w.child<QLabel>("warningText")->text().isEmpty(), "said once");
  w.shot("tilted");
}

VOLUMEN_TEST(TestFilesOfTheWindow);
#include "tst_files_of_the_window.moc"
