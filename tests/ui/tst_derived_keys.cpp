// Guards which values a workspace needs, without a window: numbers and reports of segments, masked volumes.
// Segments that are gone are not kept in memory.
#include <QAction>
#include <QSignalSpy>

#include "tests/ui/surface_session.h"
#include "tests/unit/suite.h"
#include "ui/controller/curve_follower.h"
#include "ui/controller/segment_jobs.h"
#include "ui/derivations/masking.h"
#include "ui/derivations/segment_numbers.h"
#include "ui/derivations/segment_reports.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Mask cutBehind(double y) {
  auto lasso = std::make_shared<Lasso>();
  lasso->down = {0, 1, 0};
  lasso->points = {{-50, y}, {50, y}, {50, 50}, {-50, 50}};
  return {false, {lasso}};
}

// Also derives the numbers and reports of its segments.
struct Derived : SurfaceSession {
  SegmentNumbers numbers{segmentNumbersRule(session, painter), session, &jobs};
  SegmentReports reports{segmentReportsRule(session, painter, reports, [] { return true; }), session, &jobs};
  void update() {
    numbers.update();
    reports.update();
  }
  void removeAll() {
    session.change(QStringLiteral("test"), [](Workspace& w) { w.segmentMaps = {}; });
  }
};

using Act = std::function<void(Derived&)>;

}  // namespace

Q_DECLARE_METATYPE(Act)

class TestDerivedKeys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersOfSegments_data();
  void numbersOfSegments();
  void numbersAreThoseOfTheVoxels();
  void reportsComeInTwoSteps();
  void maskedVolumes_data();
  void maskedVolumes();
  void aMaskThatCannotBeMadeIsTakenBack();
  void aVolumeThatWasDroppedIsMadeAgain();
  void labelsAreReleased_data();
  void labelsAreReleased();
};

void TestDerivedKeys::numbersOfSegments_data() {
  QTest::addColumn<Act>("act");
  QTest::addColumn<int>("numbers");
  QTest::addColumn<int>("others");
  const auto row = [](const char* name, int numbers, int others, Act act) {
    QTest::newRow(name) << act << numbers << others;
  };
  row("nothing happened", 2, 0, [](Derived&) {});
  row("renamed", 2, 0, [](Derived& d) {
    d.change(withSegmentChanged(d.session.workspace(), d.key, 1, [](Segment& s) { s.label = "new"; }));
  });
  row("another segment is current", 2, 1,
      [](Derived& d) { d.change(withCurrentSegment(d.session.workspace(), d.key, 1)); });
  row("painted", 2, 2, [](Derived& d) { d.addVoxel(); });
  row("cut away", 2, 0, [](Derived& d) { (void)d.cut(cutBehind(5)); });
  row("no segment", 0, 0, [](Derived& d) { d.removeAll(); });
}

// Values are those of the whole volume.
void TestDerivedKeys::numbersOfSegments() {
  QFETCH(Act, act);
  QFETCH(int, numbers);
  QFETCH(int, others);
  Derived d;
  const auto wanted = segmentNumbersRule(d.session, d.painter).wanted;
  const auto wantedReports = segmentReportsRule(d.session, d.painter, d.reports, [] { return true; }).wanted;
  const std::vector<SegmentNumbersKey> before = wanted();
  act(d);
  const std::vector<SegmentNumbersKey> after = wanted();
  QCOMPARE(int(after.size()), numbers);
  QCOMPARE(int(std::ranges::count_if(
               after, [&](const SegmentNumbersKey& key) { return std::ranges::count(before, key) == 0; })),
           others);
  QCOMPARE(int(wantedReports().size()), numbers);
}

void TestDerivedKeys::numbersAreThoseOfTheVoxels() {
  Derived d;
  d.update();
  QVERIFY(d.idle());
  const auto* counted = d.numbers.find({d.map().labels});
  QVERIFY(counted && counted->value->voxels == labelCounts(*d.map().labels));
  const auto* measured = d.numbers.find(currentValuesKey(d.session));
  QVERIFY(measured);
  QCOMPARE(measured->value->values.mean, 500.0);
}

void TestDerivedKeys::reportsComeInTwoSteps() {
  Derived d;
  QSignalSpy changed(&d.reports, &SegmentReports::changed);
  d.update();
  const auto at = [&](bool withSurfaces) {
    return d.reports.find(segmentReportsKey(d.session, withSurfaces));
  };
  QTRY_VERIFY_WITH_TIMEOUT(at(false), longest);
  QTRY_VERIFY_WITH_TIMEOUT(at(true), longest);
  QCOMPARE(at(false)->value->size(), std::size_t(2));
  QVERIFY((*at(false)->value)[0].form->ofVoxelsAlone && !(*at(true)->value)[0].form->ofVoxelsAlone);
}

void TestDerivedKeys::maskedVolumes_data() {
  QTest::addColumn<Act>("act");
  QTest::addColumn<int>("wanted");
  const auto row = [](const char* name, int wanted, Act act) { QTest::newRow(name) << act << wanted; };
  const auto mask = [](Derived& d) { d.session.setMask(QStringLiteral("test"), d.key, cutBehind(5)); };
  row("no mask", 0, [](Derived&) {});
  row("a mask", 1, mask);
  row("its volume is there", 0, [](Derived& d) { (void)d.cut(cutBehind(5)); });
  row("the series is not in memory", 0, [mask](Derived& d) {
    mask(d);
    d.session.pool().clear();
  });
  row("undone", 0, [mask](Derived& d) {
    mask(d);
    d.undo();
  });
}

void TestDerivedKeys::maskedVolumes() {
  QFETCH(Act, act);
  QFETCH(int, wanted);
  Derived d;
  act(d);
  QCOMPARE(int(maskedVolumesRule(d.session, [] { return std::nullopt; }).wanted().size()), wanted);
  // The volume of the next step comes first.
  const PoolKey next{d.key, cutBehind(9)};
  const auto withNext = maskedVolumesRule(d.session, [&] { return std::optional(next); }).wanted();
  const bool isThere = d.session.seriesWith(d.key, {}) != nullptr;
  QCOMPARE(int(withNext.size()), isThere ? wanted + 1 : 0);
  QVERIFY(withNext.empty() || withNext.front() == next);
}

// Values of the balls are no Hounsfield units.
void TestDerivedKeys::aMaskThatCannotBeMadeIsTakenBack() {
  Derived d;
  Masking masking(d.session, d.jobs);
  const QSignalSpy failed(&masking, &Masking::failed);
  d.session.setMask(QStringLiteral("test"), d.key, {true, {}});
  QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, longest);
  QVERIFY(d.session.maskOf(d.key).empty());
  QVERIFY(d.session.seriesNamed(d.key) == d.series);
}

void TestDerivedKeys::aVolumeThatWasDroppedIsMadeAgain() {
  Derived d;
  Masking masking(d.session, d.jobs);
  masking.cut(d.key, *cutBehind(5).lassos.front());
  const auto isCut = [&] { return !d.session.maskOf(d.key).empty() && d.session.seriesNamed(d.key); };
  QTRY_VERIFY_WITH_TIMEOUT(isCut(), longest);
  const auto cut = d.session.seriesNamed(d.key)->volume->stored();
  d.undo();
  QVERIFY(d.session.seriesNamed(d.key) == d.series);
  d.session.pool().clear();
  d.session.keep(d.series);
  d.session.undoStack().redo();
  QTRY_VERIFY_WITH_TIMEOUT(isCut(), longest);
  QVERIFY(d.session.seriesNamed(d.key)->volume->stored() == cut);
  QCOMPARE(d.session.undoStack().undoText(), QStringLiteral("Cut inside"));
}

void TestDerivedKeys::labelsAreReleased_data() {
  QTest::addColumn<bool>("isUnderWay");
  QTest::newRow("once they were measured") << false;
  QTest::newRow("while they are measured") << true;
}

// Surfaces, numbers, reports, a change and a curve that is followed use them.
void TestDerivedKeys::labelsAreReleased() {
  QFETCH(bool, isUnderWay);
  Derived d;
  SegmentJobs segmenter(d.session, d.painter, d.jobs);
  CurveFollower follower(d.session, d.painter, d.jobs);
  d.change(withSegmentChanged(d.session.workspace(), d.key, 1, [](Segment& s) { s.span = {0, 1}; }));
  std::vector<std::weak_ptr<const LabelMap>> labels{d.map().labels};
  follower.follow();
  d.update();
  if (!isUnderWay) QVERIFY(d.idle());
  SegmentWork work;
  work.series = d.key, work.volume = d.series->volume, work.number = 2;
  work.makeAll = [](const SegmentMap& map, const CancelToken&) -> Result<SegmentMap> {
    SegmentMap changed = map;
    changed.labels = std::make_shared<LabelMap>(withLabel(*map.labels, 2, maskOf(*map.labels, 1)));
    return changed;
  };
  segmenter.change(work);
  if (!isUnderWay) QVERIFY(d.idle());
  labels.push_back(d.map().labels);
  d.update();
  if (!isUnderWay) QVERIFY(d.idle());
  d.removeAll();
  d.update();
  d.session.undoStack().clear();
  for (const auto& each : labels) QVERIFY(QTest::qWaitFor([&] { return each.expired(); }, longest));
}

VOLUMEN_TEST(TestDerivedKeys);
#include "tst_derived_keys.moc"
