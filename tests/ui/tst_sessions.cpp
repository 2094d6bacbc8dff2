// Guards design.md 8 and 11: a session is saved, opened and drawn as it was.
#include <QMenu>

#include "tests/fixtures/program.h"
#include "tests/ui/gestures.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "ui/controller/session_files.h"
#include "ui/document/jobs.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Banner* banner(Journey& w) { return w.child<Banner>("banner"); }

}  // namespace

class TestSessions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void itComesBackAsItWas();
  void theTableIsRemovedAgain();
  void openingIsAStepThatCanBeUndone();
  void undoneItIsNotWrittenOverTheFile();
  void aStepThatCancelsItselfKeepsTheFile();
  void aSeriesThatIsMissingIsNamed();
  void aSeriesThatHasChangedIsNamed_data();
  void aSeriesThatHasChangedIsNamed();
  void aMissingSeriesThatIsOpenedIsShownAsItWas();
  void aFolderThatWasMovedIsFound();
  void whatIsNoSessionIsASentence_data();
  void whatIsNoSessionIsASentence();
  void theTitleSaysWhatIsNotSaved();
  void itIsAmongTheRecentFiles();
};

void TestSessions::itComesBackAsItWas() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  // Opens another series and changes layout, view, slice, zoom, window and level by mouse and keys.
  QVERIFY(settles(w, [&] { w.window.open({QStringLiteral("phantom:soft-sphere:32")}); }));
  QVERIFY(settles(w, [&] { w.window.open({folder.ct()}); }));
  w.child<QAction>("layoutPlanes")->trigger();
  FlatView* axial = w.window.views()->viewAs<FlatView>(axialViewId);
  QVERIFY(axial);
  drag(axial, {60, 60}, {80, 50});
  drag(axial, {60, 60}, {70, 75}, Qt::MiddleButton);
  drag(axial, {60, 60}, {62, 30}, Qt::RightButton);
  QTest::keyClick(axial, Qt::Key_Down);
  QVERIFY(settles(w, [&] { drag(w.window.view(), {100, 100}, {130, 90}); }));
  QVERIFY(settles(w, [&] {
    w.window.session().setGoal(QStringLiteral("Level"), {.level = {Quality::high, 1}});
  }));
  const Workspace saved = w.window.session().workspace();
  const QImage picture = w.window.view()->picture();
  QVERIFY(folder.save(w));
  w.window.session().show(nullptr);
  QVERIFY(w.window.session().workspace().series.empty());
  QVERIFY(folder.open(w));
  QVERIFY(w.window.session().workspace() == saved);
  QVERIFY(w.window.view()->picture() == picture);
  QVERIFY2(w.window.session().undoStack().canUndo(), "what was closed before it comes back");
  // Opens in another window, given as a path.
  Journey another;
  QVERIFY(settles(another, [&] { another.window.open({folder.at("s.volumen")}); }));
  QVERIFY(another.window.session().workspace() == saved);
  QVERIFY2(!another.window.session().undoStack().canUndo(), "the first of a window, like the first series");
  // Saving it again writes the same file.
  QVERIFY(saveSession(folder.at("again.volumen").toStdString(), another.window.session().workspace()));
  QVERIFY(contentsOf(folder.at("again.volumen")) == contentsOf(folder.at("s.volumen")));
}

void TestSessions::theTableIsRemovedAgain() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(!w.after("viewPosterior").isNull());
  const QImage with = w.window.view()->picture();
  QVERIFY(w.after("removeTable") != with);
  QVERIFY(folder.save(w));
  Journey again;
  QVERIFY(folder.open(again));
  QVERIFY(again.window.session().maskOf(keyOf(again.window.session().series()->series)).tableRemoved);
  QVERIFY(again.child<QAction>("removeTable")->isChecked());
  QVERIFY(again.window.session().state().series->volume->attributes().cut.table);
  const QImage opened = again.window.view()->picture();
  QVERIFY(again.after("removeTable") != opened);
}

void TestSessions::openingIsAStepThatCanBeUndone() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(folder.save(w));
  QVERIFY(!w.after("viewLeft").isNull());
  QVERIFY(settles(w, [&] { w.window.open({QStringLiteral("phantom:sphere:32")}); }));
  const Workspace before = w.window.session().workspace();
  QVERIFY(folder.open(w));
  QVERIFY(w.window.session().workspace() != before);
  QVERIFY(!w.after("undo").isNull());
  QVERIFY(w.window.session().workspace() == before);
}

void TestSessions::undoneItIsNotWrittenOverTheFile() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(folder.save(w));
  const QByteArray bytes = contentsOf(folder.at("s.volumen"));
  w.window.session().show(nullptr);
  QVERIFY(settles(w, [&] { w.window.open({QStringLiteral("phantom:sphere:32")}); }));
  QVERIFY(folder.open(w));
  QVERIFY(!w.after("undo").isNull());
  w.child<QAction>("saveSession")->trigger();
  // It asks for a path.
  answer(w, "saveSessionDialog", folder.at("other.volumen"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.at("other.volumen")), longest);
  QVERIFY(contentsOf(folder.at("s.volumen")) == bytes);
}

// The step leaves fewer undo steps than when the file was opened, although nothing was undone.
void TestSessions::aStepThatCancelsItselfKeepsTheFile() {
  Jobs jobs;
  Session session;
  SessionFiles files(session, jobs);
  session.show(ballSeries());
  const auto show = [&](bool shown) {
    session.change(
        QStringLiteral("Measurements"), [&](Workspace& w) { w.measurementsShown = shown; },
        QStringLiteral("one gesture"));
  };
  const bool shown = session.workspace().measurementsShown;
  session.change(QStringLiteral("Crosshair"), [](Workspace& w) { w.crosshairs.editOrAdd("f").at.x = 1; });
  show(!shown);
  const QString path = QStringLiteral("/sessions/a.volumen");
  files.opened(path);
  const int steps = session.undoStack().index();
  show(shown);
  QCOMPARE(session.undoStack().index(), steps - 1);
  QCOMPARE(files.path(), path);
  session.undoStack().undo();
  QCOMPARE(files.path(), QString());
}

void TestSessions::aSeriesThatIsMissingIsNamed() {
  const SessionFolder folder;
  Workspace saved;
  {
    Journey w({folder.ct()});
    QVERIFY(w.settle());
    QVERIFY(settles(w, [&] { w.window.open({QStringLiteral("phantom:sphere:32")}); }));
    QVERIFY(folder.save(w));
    saved = w.window.session().workspace();
  }
  QVERIFY(QFile::remove(folder.ct()));
  Journey w;
  QVERIFY2(folder.open(w), "the rest opens");
  QVERIFY2(banner(w)->sentence().contains(folder.ct()) &&
               banner(w)->sentence().contains(QStringLiteral("not found")),
           qPrintable(banner(w)->sentence()));
  const Workspace& now = w.window.session().workspace();
  QVERIFY(now.views == saved.views);
  // It is not searched for repeatedly.
  banner(w)->hide();
  QVERIFY(!w.after("viewLeft").isNull());
  QVERIFY(banner(w)->isHidden());
}

void TestSessions::aSeriesThatHasChangedIsNamed_data() {
  QTest::addColumn<int>("change");
  QTest::addColumn<QString>("words");
  QTest::newRow("fewer slices") << 0 << QStringLiteral("slices instead of");
  QTest::newRow("other spacing") << 1 << QStringLiteral("voxels have another size");
  QTest::newRow("elsewhere") << 2 << QStringLiteral("lies elsewhere");
  QTest::newRow("other type") << 3 << QStringLiteral("values are float32 instead of int16");
}

void TestSessions::aSeriesThatHasChangedIsNamed() {
  const SessionFolder folder;
  QFETCH(int, change);
  QFETCH(QString, words);
  {
    Journey w({folder.ct()});
    QVERIFY(w.settle());
    QVERIFY(folder.save(w));
  }
  const VolumePtr was = CtWithTable::volume(true);
  VolumeParts parts{was->geometry(), was->stored(), was->slope(), was->intercept(), was->attributes()};
  auto& stored = std::get<std::vector<std::int16_t>>(parts.values);
  if (change == 0) {
    --parts.geometry.size.z;
    stored.resize(std::size_t(parts.geometry.voxelCount()));
  }
  if (change == 1) parts.geometry.patientFromVoxelStep *= 2;
  if (change == 2) parts.geometry.origin.x += 5;
  if (change == 3) parts.values = std::vector<float>(stored.begin(), stored.end());
  std::vector<std::string> warnings;
  QVERIFY(writeVolume(**Volume::make(std::move(parts), warnings), folder.ct().toStdString()));
  Journey w;
  w.window.open({folder.at("s.volumen")});
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->isVisible(), longest);
  QVERIFY2(banner(w)->sentence().contains(folder.ct()) && banner(w)->sentence().contains(words),
           qPrintable(banner(w)->sentence()));
  QVERIFY2(!w.window.session().series(), "its view is empty");
  QVERIFY(w.window.views()->isVisible());
}

void TestSessions::aMissingSeriesThatIsOpenedIsShownAsItWas() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(!w.after("viewLeft").isNull());
  const QImage picture = w.window.view()->picture();
  QVERIFY(folder.save(w));
  const Workspace saved = w.window.session().workspace();
  QVERIFY(QFile::rename(folder.ct(), folder.at("away.nrrd")));
  w.window.session().show(nullptr);
  w.window.open({folder.at("s.volumen")});
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->isVisible(), longest);
  QVERIFY(QFile::rename(folder.at("away.nrrd"), folder.ct()));
  QVERIFY(settles(w, [&] { w.window.open({folder.ct()}); }));
  QVERIFY(w.window.session().workspace() == saved);
  QVERIFY(w.window.view()->picture() == picture);
}

void TestSessions::aFolderThatWasMovedIsFound() {
  const SessionFolder folder;
  QImage picture;
  {
    Journey w({folder.ct()});
    QVERIFY(w.settle());
    QVERIFY(!w.after("viewLeft").isNull());
    QVERIFY(folder.save(w));
    // Maximised, the view has the same size in both windows. Beside panels its size depends on their texts.
    picture = w.after("maximise");
    QVERIFY(!picture.isNull());
  }
  const QTemporaryDir elsewhere;
  for (const char* name : {"s.volumen", "ct.nrrd"})
    QVERIFY(QFile::rename(folder.at(name), elsewhere.filePath(QLatin1String(name))));
  Journey w;
  QVERIFY(settles(w, [&] { w.window.open({elsewhere.filePath(QStringLiteral("s.volumen"))}); }));
  QVERIFY(banner(w)->isHidden());
  QCOMPARE(w.after("maximise"), picture);
}

void TestSessions::whatIsNoSessionIsASentence_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("why");
  QTest::newRow("empty") << QByteArray() << QStringLiteral("JSON");
  QTest::newRow("a scene") << QByteArray("{\"volumenScene\": 1}")
                           << QStringLiteral("volumenSession must be 1");
  QTest::newRow("100 MB") << QByteArray(100 << 20, ' ') << QStringLiteral("larger than 8 MiB");
  QTest::newRow("nested") << QByteArray(100000, '[') << QStringLiteral("nested too deeply");
}

void TestSessions::whatIsNoSessionIsASentence() {
  const SessionFolder folder;
  QFETCH(QByteArray, text);
  QFETCH(QString, why);
  QFile file(folder.at("s.volumen"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(text);
  file.close();
  Journey w({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  const Workspace before = w.window.session().workspace();
  w.window.open({folder.at("s.volumen")});
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->isVisible(), longest);
  QVERIFY2(banner(w)->sentence().contains(folder.at("s.volumen")) && banner(w)->sentence().contains(why),
           qPrintable(banner(w)->sentence()));
  QVERIFY(w.window.session().workspace() == before);
}

void TestSessions::theTitleSaysWhatIsNotSaved() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY2(!w.window.isWindowModified(), "in no file yet");
  QVERIFY(folder.save(w));
  QVERIFY(!w.window.isWindowModified());
  QVERIFY(!w.after("viewLeft").isNull());
  QVERIFY(w.window.isWindowModified());
  QVERIFY(!w.after("undo").isNull());
  QTRY_VERIFY(!w.window.isWindowModified());
  QVERIFY(!w.after("viewRight").isNull());
  w.child<QAction>("saveSession")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.isWindowModified(), longest);
  w.child<QAction>("layoutPlanes")->trigger();
  QTRY_VERIFY(w.window.isWindowModified());
  w.child<QAction>("saveSession")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.isWindowModified(), longest);
  QTest::mouseClick(w.window.views()->viewAs<FlatView>(coronalViewId), Qt::LeftButton, {}, {50, 50});
  QVERIFY2(!w.window.isWindowModified(), "another view in focus is no change");
}

void TestSessions::itIsAmongTheRecentFiles() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(folder.save(w));
  const auto* menu = qobject_cast<QMenu*>(w.child<QAction>("clearRecentMenu")->parent());
  QTRY_COMPARE_WITH_TIMEOUT(menu->actions()[0]->text(), folder.at("s.volumen"), longest);
}

VOLUMEN_TEST(TestSessions);
#include "tst_sessions.moc"
