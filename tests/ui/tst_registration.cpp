// Guards "Register in the background": the result links two frames of reference, whatever is done meanwhile.
// Real events.
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/registration_jobs.h"
#include "ui/panels/flat_menus.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/link_text.h"

using namespace volumen;
using namespace volumen::tests;

class TestRegistration : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void registrationLinksTwoFrames();
  void registrationIsCancelled();
  void theWindowClosesWhileItRegisters();
  void registrationThatFailsIsASentence();
  void aSeriesThatIsClosedEndsIt();
  void anotherSeriesMayBeChosenMeanwhile();
  void anOverlayGoesThroughTheLink();
};

void TestRegistration::registrationLinksTwoFrames() {
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

void TestRegistration::registrationIsCancelled() {
  TwoSeries w(lumpsIn("A", {0, 0, 0}), lumpsIn("B", {9, -6, 12}));
  auto* registrar = w.window.findChild<RegistrationJobs*>();
  QSignalSpy found(registrar, &RegistrationJobs::found);
  w.press("register");
  const std::vector<JobRow> rows = w.window.jobs().rows();
  QCOMPARE(rows.size(), std::size_t(1));
  QVERIFY(rows[0].text.startsWith(QStringLiteral("Registering")));
  w.window.jobs().cancel(rows[0].id);
  QVERIFY(!registrar->pair());
  QTest::qWait(200);
  QCOMPARE(found.count(), 0);
  QVERIFY(w.workspace().frameLinks.empty());
  QVERIFY(w.child<QAction>("register")->isEnabled());
}

void TestRegistration::theWindowClosesWhileItRegisters() {
  TwoSeries w(lumpsIn("A", {0, 0, 0}), lumpsIn("B", {9, -6, 12}));
  w.press("register");
  QCOMPARE(w.window.jobs().rows().size(), std::size_t(1));
}

void TestRegistration::registrationThatFailsIsASentence() {
  auto empty = std::make_shared<LoadedSeries>(*lumpsIn("B", {0, 0, 0}));
  const VoxelGeometry geometry = empty->volume->geometry();
  std::vector<std::string> warnings;
  empty->volume = *Volume::make(
      {geometry, std::vector<std::int16_t>(std::size_t(geometry.voxelCount())), 1, 0, {}}, warnings);
  TwoSeries w(lumpsIn("A", {0, 0, 0}), empty);
  QSignalSpy failed(w.window.findChild<RegistrationJobs*>(), &RegistrationJobs::failed);
  w.press("register");
  QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, longest);
  QCOMPARE(failed.front().front().toString(),
           QStringLiteral("Cannot register: the second series has the same value everywhere."));
  QVERIFY(w.workspace().frameLinks.empty());
}

void TestRegistration::aSeriesThatIsClosedEndsIt() {
  const LoadedSeriesPtr moving = lumpsIn("B", {9, -6, 12});
  TwoSeries w(lumpsIn("A", {0, 0, 0}), moving);
  auto* registrar = w.window.findChild<RegistrationJobs*>();
  QSignalSpy found(registrar, &RegistrationJobs::found);
  w.press("register");
  QVERIFY(registrar->pair());
  w.session().close({keyOf(moving->series)});
  QVERIFY2(!registrar->pair(), "at once");
  QVERIFY(w.window.jobs().rows().empty());
  QTest::qWait(200);
  QCOMPARE(found.count(), 0);
  QVERIFY(w.workspace().frameLinks.empty());
  QVERIFY2(w.child<Banner>("banner")->isHidden(), "nothing went wrong");
}

// The result belongs to the two requested series, and applies once they are shown again.
void TestRegistration::anotherSeriesMayBeChosenMeanwhile() {
  const LoadedSeriesPtr moving = lumpsIn("B", {9, -6, 12}), third = lumpsIn("C", {0, 0, 0});
  TwoSeries w(lumpsIn("A", {0, 0, 0}), moving);
  w.press("register");
  w.session().show(third, right);
  QVERIFY(w.workspace().view(right).series == keyOf(third->series));
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().frameLinks.size(), std::size_t(1), longest);
  const FrameLink link = w.workspace().frameLinks.front();
  QCOMPARE(link.from, std::string("A"));
  QCOMPARE(link.to, std::string("B"));
  QVERIFY(w.workspace().view(right).series == keyOf(third->series));
  QVERIFY(!w.corner(right).contains(QStringLiteral("linked by registration")));
  QVERIFY(w.session().showAgain(moving->series, right));
  QCOMPARE(w.corner(right).section(QLatin1Char('\n'), -1), QStringLiteral("linked by registration"));
}

void TestRegistration::anOverlayGoesThroughTheLink() {
  const glm::dvec3 moved(9, -6, 12);
  const LoadedSeriesPtr under = lumpsIn("A", {0, 0, 0}), over = lumpsIn("B", moved);
  TwoSeries w(under, over);
  QVERIFY(!whyNotOverlaid(w.workspace(), under->series, over->series).isEmpty());
  w.session().change({}, withRegistration(w.workspace(), "A", "B", {glm::dmat3(1), moved}));
  QVERIFY(whyNotOverlaid(w.workspace(), under->series, over->series).isEmpty());
  // The registered series covers itself: everything is in the overlay's colours.
  QSignalSpy settled(w.view(left), &FlatView::settled);
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

VOLUMEN_TEST(TestRegistration);
#include "tst_registration.moc"
