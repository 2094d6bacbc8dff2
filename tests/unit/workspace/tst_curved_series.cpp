// Guards curved series in the workspace: their names, what sessions keep of them with and without their
// source, and linked positions.
#include <QLocale>
#include <algorithm>
#include <glm/geometric.hpp>

#include "io/curved.h"
#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "ui/workspace/curved_links.h"
#include "ui/workspace/curved_planes.h"
#include "ui/workspace/curved_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/links.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/needed_series.h"
#include "ui/workspace/session.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using glm::dvec3;

class TestCurvedSeries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreNamedAfterTheirCurve();
  void eachCurveIsASeriesOfItsOwn();
  void fromThePatientsRight();
  void aPlaceIsToldByTheLengthOfTheDrawnCurve_data();
  void aPlaceIsToldByTheLengthOfTheDrawnCurve();
  void aLineIsLaidOutAsBefore();
  void whatWasLaidOutBeforeGivesWay();
  void aSessionKeepsThem();
  void withoutTheirSourceTheyAreMissingUntilItIsFound();
  void aCurveThatCannotBeIsRefusedInASession_data();
  void aCurveThatCannotBeIsRefusedInASession();
  void positionsFollow();
  void whatIsLinkedFollowsTheCurve();
  void theyGoWithTheirSourceUnlessMeasuredOn();
  void theirSourceIsAskedForFirst();
};

namespace {

const std::vector<dvec3> arch{{-24, 0, 3}, {-16, -14, 3}, {0, -18, 3}, {16, -14, 3}, {24, 0, 3}};

Series head() {
  Series series;
  series.path = "/data/head", series.id = "2.25.1", series.seriesUid = "2.25.1";
  series.format = "DICOM";
  series.frameOfReferenceUid = "2.25.7";
  series.modality = "CT", series.unit = "HU", series.patientName = "Doe^Jane", series.studyUid = "2.25.2";
  series.acquired.size = {64, 64, 40};
  series.acquired.patientFromVoxelStep = {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
  series.acquired.origin = {-31.5, -31.5, -39};
  series.valueType = "int16";
  return series;
}

// Returns a head with a curve whose planes are not shown yet.
Workspace withCurve(const std::vector<dvec3>& points = arch) {
  Workspace workspace;
  workspace.series.editOrAdd(keyOf(head())).series = std::make_shared<const Series>(head());
  workspace.measurements.push_back({3, keyOf(head()), {ShapeKind::openCurve, "", points, {}, {}, {}}, {}});
  workspace.selected = 3;
  return workspace;
}

CurvedPair pairIn(const Workspace& workspace, double halfWidth = 25) {
  return *curvedPair(workspace, *curveMeant(workspace), {0, 0, 1}, halfWidth);
}

Workspace shownIn(const Workspace& workspace) { return withCurvedPlanes(workspace, pairIn(workspace)); }

SavedSession readAgain(const Workspace& workspace, bool isThere) {
  const auto text = sessionToJson(workspace, "/sessions");
  if (!text) throw std::runtime_error(text.message());
  const auto read = sessionFromJson(*text, [&](const SavedSeries& saved) {
    return isThere && saved.series.id == head().id ? std::make_shared<const Series>(head()) : nullptr;
  });
  if (!read) throw std::runtime_error(read.message());
  return *read;
}

}  // namespace

void TestCurvedSeries::theyAreNamedAfterTheirCurve() {
  Workspace workspace = withCurve();
  const CurvedPair pair = pairIn(workspace);
  QCOMPARE(seriesText(pair.straightened), QStringLiteral("CT Curve 3, straightened"));
  QCOMPARE(seriesText(pair.stretched), QStringLiteral("CT Curve 3, stretched"));
  QCOMPARE(patientText(pair.stretched), patientText(head()));
  QCOMPARE(pair.stretched.unit, std::string("HU"));
  QVERIFY(!knowsSides(pair.straightened) && knowsSides(head()));
  QVERIFY(!areTimePoints(pair.straightened, pair.stretched));
  QVERIFY(pair.straightened.warnings.size() == 1 &&
          pair.straightened.warnings[0].kind == WarningKind::curved);
  workspace.measurements.editIf([](const Measurement&) { return true; },
                                [](Measurement& m) { m.shape.name = "LAD"; });
  QCOMPARE(seriesText(pairIn(workspace).stretched), QStringLiteral("CT LAD, stretched"));
}

void TestCurvedSeries::eachCurveIsASeriesOfItsOwn() {
  const CurvedPair pair = pairIn(withCurve());
  QVERIFY(keyOf(pair.straightened) != keyOf(pair.stretched));
  QVERIFY(keyOf(pair.straightened) != keyOf(head()));
  QVERIFY(frameOfReference(pair.straightened) != frameOfReference(pair.stretched));
  QVERIFY(keyOf(pairIn(withCurve()).stretched) == keyOf(pair.stretched));
  QVERIFY(pairIn(withCurve()).stretched == pair.stretched);
  QVERIFY(keyOf(pairIn(withCurve(), 24).stretched) != keyOf(pair.stretched));
  std::vector<dvec3> moved = arch;
  moved[2].y += 1e-9;
  QVERIFY(keyOf(pairIn(withCurve(moved)).stretched) != keyOf(pair.stretched));
}

// Curves run from the patient's right, as pictures are displayed, whichever way they were drawn.
void TestCurvedSeries::fromThePatientsRight() {
  std::vector<dvec3> back(arch.rbegin(), arch.rend());
  const CurvedPair pair = pairIn(withCurve(back));
  QVERIFY(pair.stretched.curved->recipe.points == arch);
  QVERIFY(pair.straightened.curved->recipe.points == arch);
  QVERIFY(!isOfEarlierCurve(withCurve(back), pair.stretched));
  QVERIFY(!isOfEarlierCurve(withCurve(back), pair.straightened));
  std::vector<dvec3> moved = back;
  moved[1].x += 1;
  QVERIFY(isOfEarlierCurve(withCurve(moved), pair.stretched));
}

void TestCurvedSeries::aPlaceIsToldByTheLengthOfTheDrawnCurve_data() {
  QTest::addColumn<bool>("leavesItsPlane");
  QTest::addColumn<bool>("fromTheLeft");
  QTest::newRow("in a plane") << false << false;
  QTest::newRow("in a plane, drawn from left to right") << false << true;
  QTest::newRow("out of its plane") << true << false;
  QTest::newRow("out of its plane, drawn from left to right") << true << true;
}

// Both planes state the same number for a patient position: its arc length from the patient's right. The
// bound is half of the last digit plus the difference between two cross-sections.
void TestCurvedSeries::aPlaceIsToldByTheLengthOfTheDrawnCurve() {
  QFETCH(bool, leavesItsPlane);
  QFETCH(bool, fromTheLeft);
  std::vector<dvec3> points = arch;
  if (leavesItsPlane) points[1].z += 9, points[2].z -= 9, points[3].z += 9;
  const SmoothCurve curve = *SmoothCurve::through(points);
  if (fromTheLeft) std::ranges::reverse(points);
  const CurvedPair pair = pairIn(withCurve(points));
  const dvec3 ruled = pair.stretched.curved->recipe.ruled;
  const auto numberOf = [](const QString& text) {
    return text.endsWith(QStringLiteral(" mm along the curve"))
               ? QLocale().toDouble(text.section(QLatin1Char(' '), 0, 0))
               : -1;
  };
  double feet = 0, mostApart = 0;
  const int parts = 4000;
  dvec3 before = curve.at(0);
  for (int n = 1; n < parts; ++n) {
    const double truth = curve.length() * n / parts;
    const dvec3 way = curve.at(truth) - before;
    before = curve.at(truth);
    feet += glm::length(way - ruled * glm::dot(way, ruled));
    if (n % 97 != 0) continue;
    SlicePlane straight, stretched;
    straight.right = {1, 0, 0}, straight.down = {0, 1, 0}, straight.centre = {3, -2, -truth};
    stretched.right = {0, 1, 0}, stretched.down = {0, 0, 1}, stretched.centre = {feet, 5, 2};
    const QString first = curvedPlaceText(pair.straightened, straight),
                  second = curvedPlaceText(pair.stretched, stretched);
    QVERIFY2(std::abs(numberOf(first) - truth) < 0.051, qPrintable(first));
    QVERIFY2(std::abs(numberOf(second) - truth) < 0.12, qPrintable(second));
    mostApart = std::max(mostApart, truth - feet);
  }
  QVERIFY(leavesItsPlane ? mostApart > 5 : mostApart < 0.01);
}

// A curve through two points gets the direction of the slices it was drawn in. Later requests from elsewhere
// keep that direction. If none is known, it is that of the slices as acquired.
void TestCurvedSeries::aLineIsLaidOutAsBefore() {
  Workspace workspace = withCurve({{-20, 0, 0}, {20, 0, 0}});
  const auto curve = [&]() -> const Measurement& { return *curveMeant(workspace); };
  QVERIFY(usualTowards(workspace, curve()) == dvec3(0, 0, 1));
  workspace = withCurvedPlanes(workspace, *curvedPair(workspace, curve(), {0, 1, 0}, 25));
  QVERIFY(glm::distance(usualTowards(workspace, curve()), dvec3(0, 1, 0)) < 1e-9);
  const CurvedPair wider = *curvedPair(workspace, curve(), usualTowards(workspace, curve()), 50);
  QVERIFY(glm::distance(wider.stretched.curved->recipe.ruled, dvec3(0, 1, 0)) < 1e-9);
  Series coronal = head();
  coronal.acquired.patientFromVoxelStep = {{1, 0, 0}, {0, 0, -1}, {0, 2, 0}};
  Workspace other = withCurve({{-20, 0, 0}, {20, 0, 0}});
  other.series.edit(keyOf(head())).series = std::make_shared<const Series>(coronal);
  const CurvedPair pair = *curvedPair(other, *curveMeant(other), usualTowards(other, *curveMeant(other)), 25);
  QVERIFY(glm::distance(pair.stretched.curved->recipe.ruled, dvec3(0, 1, 0)) < 1e-9);
}

void TestCurvedSeries::whatWasLaidOutBeforeGivesWay() {
  Workspace workspace = shownIn(withCurve());
  QCOMPARE(workspace.series.size(), std::size_t(3));
  const SeriesKey first = keyOf(pairIn(workspace).stretched);
  workspace = withCurvedPlanes(workspace, pairIn(workspace, 10));
  QCOMPARE(workspace.series.size(), std::size_t(3));
  QVERIFY(!workspace.series.contains(first));
  // A curved series with measurements stays.
  const SeriesKey second = keyOf(pairIn(workspace, 10).stretched);
  workspace.measurements.push_back({9, second, {ShapeKind::probe, "", {{0, 0, 0}}, {}, {}, {}}, {}});
  workspace = withCurvedPlanes(workspace, pairIn(workspace, 15));
  QCOMPARE(workspace.series.size(), std::size_t(4));
  QVERIFY(workspace.series.contains(second));
}

void TestCurvedSeries::aSessionKeepsThem() {
  Workspace workspace = shownIn(withCurve());
  workspace.crosshairs.editOrAdd(frameOfReference(pairIn(workspace).stretched)).at = {20, 1, 3};
  workspace.selected = 0;  // sessions do not store it
  QVERIFY(readAgain(workspace, true).workspace == workspace);
}

void TestCurvedSeries::withoutTheirSourceTheyAreMissingUntilItIsFound() {
  Workspace workspace = shownIn(withCurve());
  workspace.selected = 0;
  const SeriesKey stretched = workspace.view(workspace.focus - 1).series;
  const Workspace read = readAgain(workspace, false).workspace;
  QVERIFY(read.series.at(stretched).missing && read.series.at(keyOf(head())).missing);
  QVERIFY(read.series.at(stretched).series->curved.has_value());
  QVERIFY(read.views == workspace.views);
  // Saving it again gives the same text.
  QCOMPARE(QString::fromStdString(*sessionToJson(read, "/sessions")),
           QString::fromStdString(*sessionToJson(workspace, "/sessions")));
  QVERIFY(withFound(read, head()) == workspace);
}

void TestCurvedSeries::aCurveThatCannotBeIsRefusedInASession_data() {
  QTest::addColumn<QString>("from");
  QTest::addColumn<QString>("to");
  QTest::newRow("no such kind") << QStringLiteral("\"kind\": \"stretched\"")
                                << QStringLiteral("\"kind\": \"bent\"");
  QTest::newRow("no direction") << QStringLiteral("\"ruled\"") << QStringLiteral("\"ruler\"");
  QTest::newRow("no width") << QStringLiteral("\"halfWidth\": 25.0") << QStringLiteral("\"halfWidth\": 0");
  QTest::newRow("no place") << QStringLiteral("\"at\"") << QStringLiteral("\"to\"");
}

void TestCurvedSeries::aCurveThatCannotBeIsRefusedInASession() {
  QFETCH(QString, from);
  QFETCH(QString, to);
  QString text = QString::fromStdString(*sessionToJson(shownIn(withCurve()), "/sessions"));
  QVERIFY2(text.contains(from), qPrintable(text.left(3000)));
  text.replace(from, to);
  const auto read = sessionFromJson(text.toStdString(), {});
  QVERIFY(!read);
  QVERIFY2(QString::fromStdString(read.message()).contains(QStringLiteral("curve")), read.message().c_str());
}

void TestCurvedSeries::positionsFollow() {
  const Workspace before = shownIn(withCurve());
  const CurvedPair pair = pairIn(before);
  const std::string source = frameOfReference(head()), straight = frameOfReference(pair.straightened),
                    stretched = frameOfReference(pair.stretched);
  const CurvedGrid grid = *CurvedGrid::make(pair.straightened.curved->recipe, head().acquired);
  Workspace moved = before;
  const dvec3 at(2, -3, grid.geometry().patientFromVoxel({0, 0, 12}).z);
  moved.crosshairs.editOrAdd(straight).at = at;
  const Workspace after = withCurvesFollowed(before, moved);
  const dvec3 inPatient = grid.patientFromCurved(at);
  QVERIFY(glm::distance(after.crosshairs.at(source).at, inPatient) < 1e-9);
  QVERIFY(after.crosshairs.at(straight).at == at);
  QVERIFY(std::abs(after.crosshairs.at(stretched).at.x - 12 * grid.geometry().spacing().z) < 0.5);
  // Far from the curve, positions are clamped to the grid.
  Workspace far = after;
  far.crosshairs.edit(source).at = {500, 500, 500};
  far = withCurvesFollowed(after, far);
  const dvec3 x = grid.geometry().voxelFromPatient(far.crosshairs.at(straight).at);
  for (int a = 0; a < 3; ++a) QVERIFY(x[a] > -1e-6 && x[a] < grid.geometry().size[a] - 1 + 1e-6);
  Workspace apart = before;
  apart.links.scroll = false;
  Workspace alone = apart;
  alone.crosshairs.editOrAdd(straight).at = at;
  QVERIFY(withCurvesFollowed(apart, alone) == alone);
}

// A registered prior follows through the series on which the curve lies.
void TestCurvedSeries::whatIsLinkedFollowsTheCurve() {
  Series prior = head();
  prior.frameOfReferenceUid = "2.25.8";
  Workspace before = shownIn(withCurve());
  const CurvedPair pair = pairIn(before);
  const dvec3 shift(5, -4, 3);
  before.frameLinks.push_back(
      {frameOfReference(head()), frameOfReference(prior), {glm::dmat3(1), shift}, true});
  const CurvedGrid grid = *CurvedGrid::make(pair.straightened.curved->recipe, head().acquired);
  Workspace moved = before;
  const dvec3 at = grid.geometry().patientFromVoxel({25, 25, 12});
  moved.crosshairs.editOrAdd(frameOfReference(pair.straightened)).at = at;
  const Workspace after = withLinksFollowed(before, moved, {});
  const dvec3 inPatient = grid.patientFromCurved(at);
  QVERIFY(glm::distance(after.crosshairs.at(frameOfReference(head())).at, inPatient) < 1e-9);
  QVERIFY(after.crosshairs.contains(frameOfReference(prior)));
  QVERIFY(glm::distance(after.crosshairs.at(frameOfReference(prior)).at, inPatient + shift) < 1e-9);
}

void TestCurvedSeries::theyGoWithTheirSourceUnlessMeasuredOn() {
  Workspace workspace = shownIn(withCurve());
  const CurvedPair pair = pairIn(workspace);
  const SeriesKey stretched = keyOf(pair.stretched);
  workspace.measurements.push_back({9, stretched, {ShapeKind::probe, "", {{0, 0, 0}}, {}, {}, {}}, {}});
  Session session;
  session.open(QStringLiteral("Open"), workspace);
  const Workspace opened = session.workspace();
  QCOMPARE(opened.series.size(), std::size_t(3));
  session.close({keyOf(head())});
  QCOMPARE(session.workspace().series.size(), std::size_t(1));
  QVERIFY(session.workspace().series.contains(stretched));
  session.undoStack().undo();
  QVERIFY(session.workspace().series == opened.series);
  QVERIFY(session.workspace().views == opened.views);
}

// Otherwise the source would be read twice: for the layout and for its own view.
void TestCurvedSeries::theirSourceIsAskedForFirst() {
  const Workspace workspace = shownIn(withCurve());
  const SeriesKey straightened = keyOf(pairIn(workspace).straightened);
  QVERIFY2(workspace.view(workspace.focus).series == straightened, "which would be the first");
  const std::vector<NeededSeries> needed = neededSeries(workspace, {}, SeriesPool());
  QVERIFY(needed.size() > 1);
  QVERIFY(keyOf(*needed[0].series) == keyOf(head()));
  QVERIFY2(keyOf(*needed[1].series) == straightened, "which does not wait for a source that cannot be read");
}

VOLUMEN_TEST(TestCurvedSeries);
#include "tst_curved_series.moc"
