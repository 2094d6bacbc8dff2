// Guards priors: the patient's earlier studies, the corresponding series in them, side-by-side display, and
// what fills an empty view automatically.
#include <functional>

#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "ui/workspace/priors.h"
#include "ui/workspace/view_window.h"

using namespace volumen;

namespace {

struct PriorSeries {
  const char *day, *description;
  const char* modality = "MR";
  const char* patient = "7";
  const char* part = "";
  bool sagittal = false;
  double thickness = 0;
  const char* number = "1";
};

Series priorSeries(const PriorSeries& s) {
  Series series;
  series.studyDate = s.day, series.studyUid = std::string("1.2.") + s.patient + "." + s.day;
  series.patientId = s.patient, series.patientName = "Doe", series.format = "DICOM";
  series.modality = s.modality, series.description = s.description, series.bodyPart = s.part;
  series.seriesNumber = s.number, series.sliceThickness = s.thickness;
  series.id = series.studyUid + s.description + s.number + s.modality, series.path = "/data";
  series.seriesUid = series.id;
  series.frameOfReferenceUid = series.studyUid + ".1";
  series.acquired.size = {32, 32, 20};
  if (s.sagittal) {  // slices along x
    series.acquired.patientFromVoxelStep[0] = {0, 1, 0};
    series.acquired.patientFromVoxelStep[1] = {0, 0, -1};
    series.acquired.patientFromVoxelStep[2] = {1, 0, 0};
  }
  series.files.assign(20, "file");
  series.frames.assign(20, 0);
  return series;
}

struct PriorStudies {
  std::vector<Series> series;
  explicit PriorStudies(const std::vector<PriorSeries>& all) {
    for (const PriorSeries& s : all) series.push_back(priorSeries(s));
  }
  std::vector<const Series*> open() const {
    std::vector<const Series*> all;
    for (const Series& s : series) all.push_back(&s);
    return all;
  }
  // Returns the index of a series; -1 for null.
  int numberOf(const Series* found) const { return found ? int(found - series.data()) : -1; }
};

}  // namespace

class TestPriors : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void earlierStudiesOfThePatient();
  void listedStudiesThatMayHoldOne();
  void whoseStudiesAreTold_data();
  void whoseStudiesAreTold();
  void whatSoundsLikeASeries_data();
  void whatSoundsLikeASeries();
  void theSameSeriesIsFound_data();
  void theSameSeriesIsFound();
  void likenessIsAShareOfAHundred();
  void currentAndPriorStandSideBySide();
  void framesStayFrames();
  void theSamePictureOfAStackIsFound();
  void datesTellStudiesApart();
  void theFirstEmptyViewIsFilled_data();
  void theFirstEmptyViewIsFilled();
};

void TestPriors::earlierStudiesOfThePatient() {
  const PriorStudies s({{"20250102", "T1"},
                        {"20230102", "T1"},
                        {"20260102", "T1"},
                        {"20240102", "T1"},
                        {"20250102", "T2"},
                        {"20240102", "T2"},
                        {"20230102", "T1", "MR", "8"},
                        {"", "T1"}});
  const PatientStudies around = studiesAround(s.open(), s.series[0]);
  const auto numbers = [&](const std::vector<const Series*>& all) {
    QList<int> found;
    for (const Series* series : all) found << s.numberOf(series);
    return found;
  };
  QCOMPARE(numbers(around.current), (QList<int>{0, 4}));
  QCOMPARE(around.priors.size(), std::size_t(2));
  QCOMPARE(numbers(around.priors[0]), (QList<int>{3, 5}));
  QCOMPARE(numbers(around.priors[1]), (QList<int>{1}));
  // Files without patient names have no priors.
  Series nobody = s.series[0], before = s.series[1];
  nobody.patientId = nobody.patientName = before.patientId = before.patientName = "";
  QVERIFY(studiesAround({&nobody, &before}, nobody).priors.empty());
}

void TestPriors::listedStudiesThatMayHoldOne() {
  const PriorStudies open({{"20260102", "T1"}, {"20240102", "T1"}});
  const auto listed = [](const char* day, const char* modalities, const char* patient = "7",
                         const char* name = "Doe") {
    IndexedStudy study;
    study.patientId = patient, study.patientName = name, study.date = day, study.modalities = modalities;
    study.studyUid = std::string("1.2.") + patient + "." + day;
    return study;
  };
  const std::vector<IndexedStudy> all{listed("20230102", "MR"),
                                      listed("20250102", "CT, MR"),
                                      listed("20240102", "MR"),
                                      listed("20260102", "MR"),
                                      listed("20270102", "MR"),
                                      listed("20220102", "CT, MRS"),
                                      listed("20230302", "MR", "8"),
                                      listed("20230402", "MR", "7", "Roe"),
                                      listed("", "MR")};
  const auto found = [&](const Series& series, const std::string& after) {
    QStringList days;
    for (const IndexedStudy& study : unopenedPriors(series, all, open.open(), after))
      days << QString::fromStdString(study.date);
    return days.join(QLatin1Char(' '));
  };
  QCOMPARE(found(open.series[0], ""), QStringLiteral("20250102 20230102"));
  QCOMPARE(found(open.series[0], "20240102"), QStringLiteral("20250102"));
  QCOMPARE(found(open.series[1], ""), QStringLiteral("20230102"));
}

void TestPriors::whoseStudiesAreTold_data() {
  using Change = std::function<void(Series & shown, Series & other)>;
  QTest::addColumn<Change>("change");
  QTest::addColumn<bool>("isPrior");
  const auto row = [](const char* name, bool isPrior, const Change& change) {
    QTest::newRow(name) << change << isPrior;
  };
  row("the same", true, [](Series&, Series&) {});
  row("another name", false, [](Series&, Series& other) { other.patientName = "Roe"; });
  row("without an ID", false, [](Series& shown, Series& other) { shown.patientId = other.patientId = ""; });
  row("nobody", false, [](Series& shown, Series& other) {
    shown.patientId = other.patientId = shown.patientName = other.patientName = "";
  });
  row("another birth date", false, [](Series&, Series& other) { other.patientBirthDate = "19810203"; });
  row("a birth date that one of them has", true, [](Series&, Series& other) { other.patientBirthDate = ""; });
  row("another sex", false, [](Series&, Series& other) { other.patientSex = "M"; });
  row("a sex that one of them has", true, [](Series& shown, Series&) { shown.patientSex = ""; });
  row("a later day", false, [](Series&, Series& other) { other.studyDate = "20260103"; });
  row("the same day", false, [](Series&, Series& other) { other.studyDate = "20260102"; });
  row("no day", false, [](Series&, Series& other) { other.studyDate = ""; });
  row("where the day of what is shown is not known", false,
      [](Series& shown, Series&) { shown.studyDate = ""; });
}

// Tests priors among open files and in the study list.
void TestPriors::whoseStudiesAreTold() {
  QFETCH(std::function<void(Series&, Series&)>, change);
  QFETCH(bool, isPrior);
  PriorStudies s({{"20260102", "T1"}, {"20240102", "T1"}});
  Series &shown = s.series[0], &other = s.series[1];
  for (Series* series : {&shown, &other}) series->patientBirthDate = "19700102", series->patientSex = "F";
  change(shown, other);
  QCOMPARE(earlierOf(shown, {&shown, &other}, ""),
           isPrior ? std::vector<const Series*>{&other} : std::vector<const Series*>());
  QVERIFY(earlierOf(shown, {&other}, "20240102").empty());
  IndexedStudy study;
  study.patientId = other.patientId, study.patientName = other.patientName, study.date = other.studyDate;
  study.birthDate = other.patientBirthDate, study.sex = other.patientSex, study.modalities = "MR";
  QCOMPARE(unopenedPriors(shown, {study}, {}, "").size(), std::size_t(isPrior));
}

void TestPriors::whatSoundsLikeASeries_data() {
  QTest::addColumn<QString>("listed");
  QTest::addColumn<bool>("sounds");
  QTest::newRow("a word of its study") << QStringLiteral("Thorax nativ") << true;
  QTest::newRow("a word of its own") << QStringLiteral("LUNG") << true;
  QTest::newRow("its body part") << QStringLiteral("Chest") << true;
  QTest::newRow("nothing said") << QString() << true;
  QTest::newRow("no more than the modality") << QStringLiteral("CT") << true;
  QTest::newRow("another word") << QStringLiteral("CT Knee") << false;
  QTest::newRow("a number alone in common") << QStringLiteral("Knee 2000") << false;
}

void TestPriors::whatSoundsLikeASeries() {
  QFETCH(QString, listed);
  QFETCH(bool, sounds);
  Series series = priorSeries({"20260102", "Lung 2000", "CT", "7", "CHEST"});
  series.studyDescription = "CT Thorax";
  IndexedStudy study;
  study.description = listed.toStdString();
  QCOMPARE(soundsLike(series, study), sounds);
}

void TestPriors::theSameSeriesIsFound_data() {
  // indices of the open series in the table below, the focused one first
  QTest::addColumn<QList<int>>("which");
  QTest::addColumn<int>("found");  // index in the table, or -1
  QTest::newRow("by the description") << QList<int>{0, 1, 2} << 1;
  QTest::newRow("by the plane") << QList<int>{0, 3, 1} << 1;
  QTest::newRow("the latest study first") << QList<int>{0, 1, 4} << 4;
  QTest::newRow("an earlier one where the latest has none") << QList<int>{0, 5, 1} << 1;
  QTest::newRow("no other part of the body") << QList<int>{0, 6} << -1;
  QTest::newRow("no other modality") << QList<int>{0, 5} << -1;
  QTest::newRow("no other patient") << QList<int>{0, 7} << -1;
  QTest::newRow("nothing of later") << QList<int>{1, 0} << -1;
  QTest::newRow("none is open") << QList<int>{0} << -1;
}

void TestPriors::theSameSeriesIsFound() {
  QFETCH(QList<int>, which);
  QFETCH(int, found);
  const PriorStudies all({{"20260102", "t2_tse_tra", "MR", "7", "BRAIN"},
                          {"20240102", "t2_tse_tra 5mm", "MR", "7", "BRAIN"},
                          {"20240102", "t1_se_tra", "MR", "7", "BRAIN"},
                          {"20240102", "t2_tse_tra", "MR", "7", "BRAIN", true},
                          {"20250102", "T2 axial", "MR"},
                          {"20250102", "t2_tse_tra", "CT"},
                          {"20240102", "t2_tse_tra", "MR", "7", "KNEE"},
                          {"20240102", "t2_tse_tra", "MR", "8", "BRAIN"}});
  std::vector<const Series*> open;
  for (const int n : which) open.push_back(&all.series[std::size_t(n)]);
  QCOMPARE(all.numberOf(priorOf({open.front()}, open).series), found);
}

void TestPriors::likenessIsAShareOfAHundred() {
  const Series a = priorSeries({"20260102", "T2 tra +C", "MR", "7", "", false, 5});
  QCOMPARE(likeness({&a}, {&a}), 100.);
  // Contrast agent and slice thickness are unknown in both, which gives half of their points.
  const Series vague = priorSeries({"20260102", "T2 tra"});
  QCOMPARE(likeness({&vague}, {&vague}), 100 - 7.5 - 5);
  const Series thin = priorSeries({"20240102", "T2 tra +C", "MR", "7", "", false, 1});
  QCOMPARE(likeness({&a}, {&thin}), 92.);
  QCOMPARE(likeness({&thin}, {&a}), likeness({&a}, {&thin}));
  const Series turned = priorSeries({"20240102", "T2 tra +C", "MR", "7", "", true, 5});
  QCOMPARE(likeness({&a}, {&turned}), 70.);
  Series rightSide = a, leftSide = a;
  rightSide.acquired.calibrated = leftSide.acquired.calibrated = false;
  rightSide.laterality = "R", leftSide.laterality = "L";
  QVERIFY(likeness({&rightSide}, {&leftSide}) < leastLikeness);
  QVERIFY(likeness({&rightSide}, {&rightSide}) >= leastLikeness);
  QCOMPARE(likeness({&rightSide}, {&a}), 0.);
  Series pa = rightSide, ap = rightSide, lateral = rightSide;
  pa.viewPosition = "PA", ap.viewPosition = "AP", lateral.viewPosition = "LL";
  QVERIFY(likeness({&pa}, {&ap}) >= leastLikeness);
  QVERIFY2(likeness({&pa}, {&ap}) < likeness({&pa}, {&pa}), "the very same comes first");
  QVERIFY(likeness({&pa}, {&lateral}) < leastLikeness);
}

void TestPriors::currentAndPriorStandSideBySide() {
  const PriorStudies s({{"20260102", "T2"}, {"20240102", "T2"}});
  Workspace before = withSeries({}, sceneViewId, s.series[0], {});
  before.links.scroll = false;
  const Workspace after = comparedWithPrior(before, {&s.series[0]}, {&s.series[1]});
  QCOMPARE(after.layout, Layout::two);
  QCOMPARE(after.focus, firstComparedId);
  QVERIFY(after.links.scroll);
  QVERIFY(after.view(firstComparedId).series == keyOf(s.series[0]));
  QVERIFY(after.view(firstComparedId + 1).series == keyOf(s.series[1]));
  for (const ViewId id : viewsOnScreen(after)) QVERIFY(after.view(id).kind == ViewKind::axial);
  // The views had windows of their own.
  Workspace alone = after;
  for (const ViewId id : viewsOnScreen(after)) alone = withWindowAlone(std::move(alone), id, true);
  const Workspace again = comparedWithPrior(alone, {&s.series[0]}, {&s.series[1]});
  for (const ViewId id : viewsOnScreen(again)) {
    QVERIFY(flatLookOf(alone.view(id)).windowAlone);
    QVERIFY(!flatLookOf(again.view(id)).windowAlone);
  }
  // The view showed 3D before.
  Workspace in3d = withLayout(before, Layout::two);
  in3d = withKind(in3d, firstComparedId, ViewKind::volume, {});
  QVERIFY(comparedWithPrior(in3d, {&s.series[0]}, {&s.series[1]}).view(firstComparedId).kind ==
          ViewKind::axial);
}

void TestPriors::framesStayFrames() {
  PriorStudies s({{"20260102", "Chest", "DX"}, {"20240102", "Chest", "DX"}});
  for (Series& series : s.series) {
    series.acquired.size.z = 1, series.acquired.calibrated = false;
    series.files.resize(1), series.frames.resize(1);
  }
  QCOMPARE(s.numberOf(priorOf({&s.series[0]}, s.open()).series), 1);
  const Workspace after = comparedWithPrior({}, {&s.series[0]}, {&s.series[1]});
  for (const ViewId id : viewsOnScreen(after)) QVERIFY(showsFrames(after.view(id).kind));
  QCOMPARE(after.focus, firstComparedId);
}

// Four mammograms of a day are one series.
void TestPriors::theSamePictureOfAStackIsFound() {
  PriorStudies s({{"20260102", "Mammo", "MG"}, {"20240102", "Mammo", "MG"}});
  const auto makeStack = [](Series& series, const std::vector<ProjectionView>& views) {
    series.acquired.size.z = int(views.size()), series.acquired.calibrated = false;
    series.files.assign(views.size(), "");
    series.frames.assign(views.size(), 0);
    for (std::size_t n = 0; n < views.size(); ++n) series.files[n] = std::to_string(n);
    setProjections(series, views);
  };
  makeStack(s.series[0], {{"R", "CC"}, {"L", "CC"}, {"R", "MLO"}, {"L", "MLO"}});
  makeStack(s.series[1], {{"L", "MLO"}, {"R", "MLO"}, {"L", "CC"}, {"R", "CC"}});
  for (int frame = 0; frame < 4; ++frame) {
    Workspace shown = withFrames({}, sceneViewId, s.series[0]);
    shown.editView(axialViewId).flats.edit(keyOf(s.series[0])).frame = frame;
    const SeriesPicture now = pictureIn(shown, axialViewId);
    QCOMPARE(now.frame, frame);
    const SeriesPicture before = priorOf(now, s.open());
    QCOMPARE(s.numberOf(before.series), 1);
    QCOMPARE(before.frame, 3 - frame);
    const Workspace after = comparedWithPrior(shown, now, before);
    QCOMPARE(flatLookOf(after.view(firstComparedId)).frame, frame);
    QCOMPARE(flatLookOf(after.view(firstComparedId + 1)).frame, 3 - frame);
  }
}

void TestPriors::datesTellStudiesApart() {
  const PriorStudies s({{"20260102", "T2"}, {"20240102", "T2"}, {"20260102", "T1"}});
  const Workspace days = comparedWithPrior({}, {&s.series[0]}, {&s.series[1]});
  QCOMPARE(dateToTellApart(days, firstComparedId), QStringLiteral("2026-01-02"));
  QCOMPARE(dateToTellApart(days, firstComparedId + 1), QStringLiteral("2024-01-02"));
  {
    const HidingNames hidden(true);
    QCOMPARE(dateToTellApart(days, firstComparedId), QStringLiteral("Current"));
    QCOMPARE(dateToTellApart(days, firstComparedId + 1), QStringLiteral("Prior"));
  }
  const Workspace oneDay = comparedWithPrior({}, {&s.series[0]}, {&s.series[2]});
  QCOMPARE(dateToTellApart(oneDay, firstComparedId), QString());
  QCOMPARE(dateToTellApart({}, firstComparedId), QString());
}

void TestPriors::theFirstEmptyViewIsFilled_data() {
  QTest::addColumn<QList<int>>("which");
  QTest::addColumn<int>("found");
  QTest::newRow("another weighting of that plane") << QList<int>{0, 1, 2, 3} << 2;
  QTest::newRow("else the prior") << QList<int>{0, 1, 3} << 3;
  QTest::newRow("the same weighting does not") << QList<int>{0, 4} << -1;
  QTest::newRow("nor what is not there") << QList<int>{0} << -1;
}

void TestPriors::theFirstEmptyViewIsFilled() {
  QFETCH(QList<int>, which);
  QFETCH(int, found);
  const PriorStudies all({{"20260102", "t2_tra"},
                          {"20260102", "t1_sag", "MR", "7", "", true},
                          {"20260102", "t1_tra"},
                          {"20240102", "t2_tra"},
                          {"20260102", "t2_tra", "MR", "7", "", false, 0, "9"}});
  std::vector<const Series*> open;
  for (const int n : which) open.push_back(&all.series[std::size_t(n)]);
  const Workspace before = withSeries({}, sceneViewId, all.series[0], {});
  const Workspace four = withLayout(before, Layout::four);
  const Workspace after = withLikelySecond(four, open);
  const SeriesKey key = found < 0 ? SeriesKey{} : keyOf(all.series[std::size_t(found)]);
  QVERIFY(after.view(firstComparedId + 1).series == key);
  QVERIFY(after.view(firstComparedId + 2).series.empty());
  QVERIFY(after.view(firstComparedId).series == keyOf(all.series[0]));
  QCOMPARE(after.focus, four.focus);
  QVERIFY2(withLikelySecond(before, open) == before, "no view to compare is on screen");
}

VOLUMEN_TEST(TestPriors);
#include "tst_priors.moc"
