// Guards how compared views follow each other: through frames of reference, by hand, and in zoom, pan and
// window if chosen. Real events.
#include <QMenu>

#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestLinks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneFrameOfReferenceScrollsTogether();
  void withoutTheLinkEachScrollsAlone();
  void anotherFrameSaysWhy();
  void lockHereKeepsTheOffset_data();
  void lockHereKeepsTheOffset();
  void turnsGoThroughTheLock();
  void zoomIsMmPerPixel_data();
  void zoomIsMmPerPixel();
  void panIsThePatientsPoint();
  void windowsAreOfOneModalityAndUnit_data();
  void windowsAreOfOneModalityAndUnit();
  void windowsOfPetAreOneUptake();
  void allOfItIsKeptInTheSession();
};

void TestLinks::oneFrameOfReferenceScrollsTogether() {
  TwoSeries w(ballIn("A"), ballIn("A", 2));
  w.scroll(left, 3);
  QCOMPARE(w.z(left), w.z(right));
  w.scroll(right, 1);
  QCOMPARE(w.z(left), w.z(right));
  QVERIFY(!w.corner(right).contains(QStringLiteral("linked")));
}

void TestLinks::withoutTheLinkEachScrollsAlone() {
  TwoSeries w(ballIn("A"), ballIn("A"));
  w.scroll(left, 2);
  const double before = w.z(right);
  w.press("linkScroll");
  QCOMPARE(w.z(right), before);
  w.scroll(left, 4);
  QCOMPARE(w.z(right), before);
  QCOMPARE(w.z(left), before - 4);
  QVERIFY(w.corner(right).contains(QStringLiteral("not linked")));
  const double alone = w.z(left);
  w.press("linkScroll");
  QCOMPARE(w.z(left), alone);
  QCOMPARE(w.z(right), alone);
  w.press("undo");
  QCOMPARE(w.z(right), before);
}

void TestLinks::anotherFrameSaysWhy() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  const double before = w.z(right);
  w.scroll(left, 3);
  QCOMPARE(w.z(right), before);
  QVERIFY(w.corner(right).contains(QStringLiteral("not linked")));
  QCOMPARE(w.tip(),
           QStringLiteral("Different frames of reference: not linked. Lock here links them by hand."));
  QVERIFY(w.child<QAction>("lockHere")->isEnabled());
  QVERIFY(!w.child<QAction>("unlock")->isEnabled());
}

void TestLinks::lockHereKeepsTheOffset_data() {
  QTest::addColumn<double>("spacing");
  QTest::newRow("the same slices") << 1.0;
  QTest::newRow("mm, not numbers of slices") << 3.0;
}

void TestLinks::lockHereKeepsTheOffset() {
  QFETCH(double, spacing);
  TwoSeries w(ballIn("A"), ballIn("B", spacing));
  w.scroll(left, 12);
  const double offset = w.z(right) - w.z(left);
  w.press("lockHere");
  QCOMPARE(w.z(right) - w.z(left), offset);
  QVERIFY2(w.corner(right).contains(QStringLiteral("linked by hand, +%1 mm").arg(std::lround(offset))),
           qPrintable(w.corner(right)));
  w.scroll(left, -5);
  QCOMPARE(w.z(right) - w.z(left), offset);
  w.scroll(right, 2);
  QCOMPARE(w.z(right) - w.z(left), offset);
  w.press("undo");
  w.press("undo");
  w.press("undo");
  QVERIFY(w.corner(right).contains(QStringLiteral("not linked")));
  w.press("redo");
  const double atRight = w.z(right);
  w.press("unlock");
  w.scroll(left, 1);
  QCOMPARE(w.z(right), atRight);
  QVERIFY(w.corner(right).contains(QStringLiteral("not linked")));
}

void TestLinks::turnsGoThroughTheLock() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  w.press("lockHere");
  w.session().change({}, [](Workspace& after) {
    after = withCrosshair(after, left, "A", after.crosshairs.at("A"),
                          turnedIn(after.crosshairs.at("A"), ViewKind::sagittal, 0.3));
  });
  QVERIFY(w.workspace().crosshairs.at("A").turned());
  QVERIFY(glm::length(w.plane(right).normal() - w.plane(left).normal()) < 1e-12);
}

void TestLinks::zoomIsMmPerPixel_data() {
  QTest::addColumn<bool>("linked");
  QTest::newRow("linked") << true;
  QTest::newRow("off at first") << false;
}

void TestLinks::zoomIsMmPerPixel() {
  QFETCH(bool, linked);
  TwoSeries w(ballIn("A"), ballIn("B", 2));
  const double before = w.plane(right).mmPerPixel;
  if (linked) w.press("linkZoom");
  w.zoom(left);
  QVERIFY(w.plane(left).mmPerPixel < 0.9 * before);
  QCOMPARE(w.plane(right).mmPerPixel, linked ? w.plane(left).mmPerPixel : before);
  w.press("undo");
  w.scroll(right, 1);
  if (linked) QCOMPARE(w.plane(right).mmPerPixel, w.plane(left).mmPerPixel);
}

void TestLinks::panIsThePatientsPoint() {
  TwoSeries w(ballIn("A"), ballIn("B", 2));
  w.pan(left);
  QCOMPARE(w.plane(right).centre.x, 0.0);
  w.press("undo");
  w.scroll(left, 6);
  w.press("lockHere");
  w.press("linkPan");
  w.pan(left);
  QVERIFY(w.plane(left).centre.x < -1);
  const glm::dvec3 from = w.workspace().crosshairs.at("B").at - w.workspace().crosshairs.at("A").at;
  QVERIFY(glm::length(w.plane(left).centre + from - w.plane(right).centre) < 1e-9);
}

void TestLinks::windowsAreOfOneModalityAndUnit_data() {
  QTest::addColumn<QByteArray>("modality");
  QTest::addColumn<bool>("linked");
  QTest::addColumn<bool>("follows");
  QTest::newRow("CT and CT") << QByteArray("CT") << true << true;
  QTest::newRow("CT and MR") << QByteArray("MR") << true << false;
  QTest::newRow("off at first") << QByteArray("CT") << false << false;
}

void TestLinks::windowsAreOfOneModalityAndUnit() {
  QFETCH(QByteArray, modality);
  QFETCH(bool, linked);
  QFETCH(bool, follows);
  TwoSeries w(ballIn("A"), ballIn("B", 1, modality.constData()));
  if (linked) w.press("linkWindow");
  drag(w.view(left), {100, 100}, {140, 130});
  const auto windowIn = [&](ViewId id) {
    return w.workspace().series.at(w.workspace().view(id).series).window;
  };
  QVERIFY(windowIn(left));
  QCOMPARE(windowIn(right) == windowIn(left), follows);
}

// 5 SUVbw in one view are 5 SUVbw in the other, whatever they are in Bq/ml.
void TestLinks::windowsOfPetAreOneUptake() {
  const auto pet = [](const char* frame, double factor) {
    auto series = std::make_shared<LoadedSeries>(*ballIn(frame, 1, "PT"));
    series->series.unit = "Bq/ml";
    series->series.suv.bodyWeight = factor;
    return series;
  };
  TwoSeries w(pet("A", 0.01), pet("B", 0.02));
  w.press("linkWindow");
  QTest::keyClick(w.view(left), Qt::Key_1);
  const auto windowIn = [&](ViewId id) {
    return *w.workspace().series.at(w.workspace().view(id).series).window;
  };
  QVERIFY(std::abs(windowIn(left).width + 500) < 1e-9);
  QVERIFY(std::abs(windowIn(right).width + 250) < 1e-9);
}

void TestLinks::allOfItIsKeptInTheSession() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  for (const char* action : {"linkZoom", "linkPan", "linkWindow"}) w.press(action);
  w.scroll(left, 5);
  w.press("lockHere");
  const Result<std::string> text = sessionToJson(w.workspace(), "");
  QVERIFY2(text, text ? "" : text.message().c_str());
  const Workspace& now = w.workspace();
  const auto back = sessionFromJson(*text, [&](const SavedSeries& saved) {
    return now.series.at({saved.series.path, saved.series.id}).series;
  });
  QVERIFY2(back, back ? "" : back.message().c_str());
  QVERIFY(back->workspace.links == now.links);
  QVERIFY(back->workspace.frameLinks == now.frameLinks);
  QCOMPARE(back->workspace.frameLinks.size(), std::size_t(1));
  w.shot("links");
}

VOLUMEN_TEST(TestLinks);
#include "tst_links.moc"
