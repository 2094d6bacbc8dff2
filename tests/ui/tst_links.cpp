// Guards how views to compare follow each other: through frames of reference, by hand, and in zoom, pan and
// window where that is wanted. Real events.
#include <QMenu>
#include <QToolButton>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/registrar.h"
#include "ui/panels/flat_menus.h"
#include "ui/views/slice_view.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr ViewId left = firstComparedId, right = firstComparedId + 1;

ShownSeriesPtr ballIn(const char* frame, double spacing = 1, const char* modality = "CT") {
  auto series = std::make_shared<ShownSeries>(*ballSeries(32, 10, {0, 0, 0}, glm::dvec3(spacing)));
  series->series.acquired = series->volume->geometry();
  series->series.frameOfReferenceUid = frame;
  series->series.modality = modality;
  series->window = {500, 1000};
  return series;
}

// Three balls of different size that no turn maps onto each other, all of them moved.
ShownSeriesPtr lumpsIn(const char* frame, glm::dvec3 moved) {
  constexpr int n = 40;
  VolumeParts parts;
  parts.geometry.size = glm::ivec3(n);
  parts.geometry.patientFromVoxelStep *= 3.0;
  parts.geometry.origin = glm::dvec3(-1.5 * (n - 1));
  std::vector<std::int16_t> values;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const glm::dvec3 p = parts.geometry.patientFromVoxel({i, j, k}) - moved;
        const auto near = [&](glm::dvec3 centre, double mm) {
          return std::clamp((mm - glm::length(p - centre)) / 3 + 0.5, 0.0, 1.0);
        };
        values.push_back(std::int16_t(1000 * near({-15, 5, 0}, 20) + 600 * near({20, 12, 8}, 12) +
                                      800 * near({4, -18, 20}, 9)));
      }
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  auto series = std::make_shared<ShownSeries>(*ballIn(frame));
  series->volume = *Volume::make(std::move(parts), warnings);
  series->series.acquired = series->volume->geometry();
  return series;
}

// Two series side by side.
struct TwoSeries : Journey {
  TwoSeries(const ShownSeriesPtr& a, const ShownSeriesPtr& b) {
    session().show(a);
    child<QAction>("layoutTwo")->trigger();
    session().show(a, left);
    session().show(b, right);
    session().setFocus(left);
    QCoreApplication::processEvents();
  }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(ViewId id) { return window.views()->sliceView(id); }
  SlicePlane plane(ViewId id) { return *view(id)->plane(); }
  double z(ViewId id) { return plane(id).centre.z; }
  void press(const char* action) { child<QAction>(action)->trigger(); }
  void scroll(ViewId id, int notches) {
    const QPointF at = view(id)->rect().center();
    QWheelEvent wheel(at, view(id)->mapToGlobal(at), {}, {0, -120 * notches}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(view(id), &wheel);
    session().endGesture();
  }
  void zoom(ViewId id) { drag(view(id), {100, 200}, {100, 150}, Qt::RightButton); }
  void pan(ViewId id) { drag(view(id), {100, 100}, {120, 130}, Qt::MiddleButton); }
  QString corner(ViewId id) { return view(id)->overlays().topRight.join(QLatin1Char('\n')); }
  QString tip() { return child<QToolButton>("linkButton")->toolTip(); }
};

}  // namespace

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
  void registrationLinksTwoFrames();
  void registrationIsCancelled();
  void registrationThatFailsIsASentence();
  void anOverlayGoesThroughTheLink();
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

void TestLinks::registrationLinksTwoFrames() {
  const glm::dvec3 moved(9, -6, 12);
  TwoSeries w(lumpsIn("A", {0, 0, 0}), lumpsIn("B", moved));
  w.scroll(left, 1);
  w.press("register");
  QTRY_VERIFY_WITH_TIMEOUT(!w.workspace().frameLinks.empty(), longest);
  QCOMPARE(w.corner(right).section(QLatin1Char('\n'), -1), QStringLiteral("linked by registration"));
  const Rigid rigid = w.workspace().frameLinks.front().toFromFrom;
  for (const glm::dvec3 p : {glm::dvec3(0), glm::dvec3(30, 0, 0), glm::dvec3(0, -20, 30)})
    QVERIFY2(glm::length(rigid(p) - p - moved) < 1, "within 1 mm");
  const auto atRight = [&] { return w.workspace().crosshairs.at("B").at; };
  const auto expected = [&] { return rigid(w.workspace().crosshairs.at("A").at); };
  QVERIFY(glm::length(atRight() - expected()) < 1e-9);
  w.scroll(left, 3);
  QVERIFY(glm::length(atRight() - expected()) < 1e-9);
  w.scroll(right, -2);
  QVERIFY(glm::length(atRight() - expected()) < 1e-9);
  w.shot("registered");
  w.press("unlock");
  QVERIFY(w.workspace().frameLinks.empty());
  w.press("undo");
  QCOMPARE(w.workspace().frameLinks.size(), std::size_t(1));
}

void TestLinks::registrationIsCancelled() {
  TwoSeries w(lumpsIn("A", {0, 0, 0}), lumpsIn("B", {9, -6, 12}));
  QSignalSpy ended(w.window.findChild<Registrar*>(), &Registrar::ended);
  w.press("register");
  w.child<QToolButton>("cancelTask")->click();
  QTRY_COMPARE_WITH_TIMEOUT(ended.count(), 1, longest);
  QCoreApplication::processEvents();
  QVERIFY(w.workspace().frameLinks.empty());
  QVERIFY(w.child<QAction>("register")->isEnabled());
}

void TestLinks::registrationThatFailsIsASentence() {
  auto empty = std::make_shared<ShownSeries>(*lumpsIn("B", {0, 0, 0}));
  const VoxelGeometry geometry = empty->volume->geometry();
  std::vector<std::string> warnings;
  empty->volume = *Volume::make(
      {geometry, std::vector<std::int16_t>(std::size_t(geometry.voxelCount())), 1, 0, {}}, warnings);
  TwoSeries w(lumpsIn("A", {0, 0, 0}), empty);
  QSignalSpy failed(w.window.findChild<Registrar*>(), &Registrar::failed);
  w.press("register");
  QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, longest);
  QCOMPARE(failed.front().front().toString(),
           QStringLiteral("Cannot register: the second series has the same value everywhere."));
  QVERIFY(w.workspace().frameLinks.empty());
}

void TestLinks::anOverlayGoesThroughTheLink() {
  const glm::dvec3 moved(9, -6, 12);
  const ShownSeriesPtr under = lumpsIn("A", {0, 0, 0}), over = lumpsIn("B", moved);
  TwoSeries w(under, over);
  QVERIFY(!whyNotOverlaid(w.workspace(), under->series, over->series).isEmpty());
  w.session().change({}, withRegistration(w.workspace(), "A", "B", {glm::dmat3(1), moved}));
  QVERIFY(whyNotOverlaid(w.workspace(), under->series, over->series).isEmpty());
  // The same series moved back lies over itself: all of it in the overlay's colours.
  QSignalSpy settled(w.view(left), &SliceView::settled);
  w.session().change({}, withOverlay(w.workspace(), left, &over->series));
  w.session().change({}, withFlatLooks(w.workspace(), left, [](FlatLook& look) {
                       look.overlayOpacity = 1;
                       look.overlayColours = ColourMap::grey;
                     }));
  QTRY_VERIFY_WITH_TIMEOUT(settled.count() > 0, longest);
  QCoreApplication::processEvents();
  const SlicePlane plane = w.plane(left);
  const QImage picture = w.view(left)->picture();
  int compared = 0;
  for (int y = 2; y < picture.height(); y += 7)
    for (int x = 2; x < picture.width(); x += 7) {
      const glm::dvec3 p = plane.patientFromPixel({x + 0.5, y + 0.5});
      const glm::dvec3 voxel = over->volume->geometry().voxelFromPatient(p + moved);
      const glm::ivec3 nearest(glm::round(voxel));
      if (glm::any(glm::lessThan(nearest, glm::ivec3(1))) ||
          glm::any(glm::greaterThan(nearest, glm::ivec3(38))))
        continue;
      float low = 1e9f, high = -1e9f;
      for (int n = 0; n < 27; ++n) {
        const glm::ivec3 at = nearest + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
        low = std::min(low, over->volume->value(at.x, at.y, at.z));
        high = std::max(high, over->volume->value(at.x, at.y, at.z));
      }
      const int grey = qRed(picture.pixel(x, y));
      QVERIFY2(grey >= int(255 * low / 1000) - 2 && grey <= int(255 * high / 1000) + 2,
               qPrintable(QStringLiteral("%1 at %2, %3").arg(grey).arg(x).arg(y)));
      ++compared;
    }
  QVERIFY(compared > 200);
  w.press("unlock");
  QVERIFY(flatLookOf(w.workspace().view(left)).overlay.empty());
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
