// Guards window.md "Save a session": moved series are found again, all at once, in a folder that the user
// names.
#include <QAbstractButton>
#include <QDir>
#include <QFileInfo>

#include "io/curved.h"
#include "io/paths/open_path.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/locate.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A session of two series whose files were both moved.
struct Moved {
  SessionFolder folder;
  QTemporaryDir elsewhere;
  Workspace saved;

  QString ball() const { return folder.at("ball.nrrd"); }
  QString there(const char* name) const { return elsewhere.filePath(QLatin1String(name)); }
  bool make() {
    if (!writeVolume(*ballSeries()->volume, ball().toStdString())) return false;
    Journey w({folder.ct()});
    if (!w.settle() || !settles(w, [&] { w.window.open({ball()}); })) return false;
    if (w.after("viewLeft").isNull()) return false;
    saved = w.window.session().workspace();
    return folder.save(w) && QDir(elsewhere.path()).mkpath(QStringLiteral("deep")) &&
           QFile::rename(folder.ct(), there("deep/ct.nrrd")) && QFile::rename(ball(), there("ball.nrrd"));
  }
};

Banner* banner(Journey& w) { return w.child<Banner>("banner"); }
QAbstractButton* locate(Journey& w) { return w.child<QAbstractButton>("bannerOffer"); }

bool opened(Journey& w, const Moved& moved) {
  w.window.open({moved.folder.at("s.volumen")});
  return QTest::qWaitFor([&] { return banner(w)->isVisible(); }, longest);
}

}  // namespace

class TestLocate : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allThatLiesThereIsFoundAtOnce();
  void whatIsNotThereIsNamedAndOfferedAgain();
  void otherMessagesOfferNothing();
  void whatCannotBeLaidOutAgainIsTold();
};

void TestLocate::allThatLiesThereIsFoundAtOnce() {
  Moved moved;
  QVERIFY(moved.make());
  Journey w;
  QVERIFY(opened(w, moved));
  QCOMPARE(banner(w)->sentence().count(QStringLiteral("not found")), 2);
  QVERIFY(locate(w)->isVisible());
  w.shot("locate");
  locate(w)->click();
  QVERIFY(settles(w, [&] { answer(w, "locateDialog", moved.elsewhere.path()); }));
  QVERIFY(banner(w)->isHidden());
  QVERIFY(!w.window.view()->picture().isNull());
  const Workspace& now = w.window.session().workspace();
  QCOMPARE(now.series.size(), moved.saved.series.size());
  for (const auto& [key, state] : now.series) {
    QVERIFY(!state.missing);
    QVERIFY(key.path.starts_with(moved.elsewhere.path().toStdString()));
  }
  const ViewState &view = now.view(sceneViewId), &was = moved.saved.view(sceneViewId);
  QCOMPARE(QString::fromStdString(view.series.path), moved.there("ball.nrrd"));
  QVERIFY2(view.scenes.at(view.series) == was.scenes.at(was.series), "as it was left");
  QCOMPARE(view.scenes.size(), was.scenes.size());
  // It is one undo step, and redo does not search for the series again.
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.window.session().workspace().series.begin()->second.missing);
  w.child<QAction>("redo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series(), longest);
}

void TestLocate::whatIsNotThereIsNamedAndOfferedAgain() {
  Moved moved;
  QVERIFY(moved.make());
  Journey w;
  QVERIFY(opened(w, moved));
  locate(w)->click();
  answer(w, "locateDialog", moved.there("deep"));
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->sentence().contains(QStringLiteral("was not found in")), longest);
  QCOMPARE(banner(w)->sentence().count(QStringLiteral("not found")), 1);
  QVERIFY(banner(w)->sentence().contains(QStringLiteral("ball")));
  QVERIFY(locate(w)->isVisible());
  locate(w)->click();
  answer(w, "locateDialog", moved.elsewhere.path());
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->isHidden(), longest);
  for (const auto& [key, state] : w.window.session().workspace().series) QVERIFY(!state.missing);
}

void TestLocate::otherMessagesOfferNothing() {
  Moved moved;
  QVERIFY(moved.make());
  Journey w;
  QVERIFY(opened(w, moved));
  w.window.open({moved.there("nothing.nrrd")});
  QTRY_VERIFY_WITH_TIMEOUT(banner(w)->sentence().contains(QStringLiteral("nothing.nrrd")), longest);
  QVERIFY(!locate(w)->isVisible());
}

// A curved series is rebuilt from a series that is found.
void TestLocate::whatCannotBeLaidOutAgainIsTold() {
  const SessionFolder folder;
  const std::string place = QFileInfo(folder.ct()).path().toStdString();
  const Result<Study> study = openPath(place);
  QVERIFY(study && study->volumes.size() == 1);
  const Series& ct = study->volumes.front();
  const CurvedRecipe recipe{CurvedKind::straightened, {{-20, 0, 0}, {20, 0, 0}}, {0, 0, 1}, 25};
  const SavedSeries saved{*curvedSeries(ct, recipe, "Curve 1"), {}, {}, proofOf(ct)};
  const auto found = volumen::locate({{saved}, {}}, place);
  QVERIFY(found && found->series.size() == 1 && found->problems.isEmpty());
  SavedSeries wrong = saved;
  wrong.series.curved->recipe.halfWidth = 0;
  const auto told = volumen::locate({{wrong}, {}}, place);
  QVERIFY(told && told->series.empty());
  QCOMPARE(told->problems.size(), 1);
  QVERIFY2(told->problems[0].contains(QStringLiteral("Curve 1, straightened cannot be laid out")) &&
               told->problems[0].contains(QStringLiteral("more than 0 mm")),
           qPrintable(told->problems[0]));
}

VOLUMEN_TEST(TestLocate);
#include "tst_locate.moc"
