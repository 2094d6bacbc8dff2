// Guards stacks of single pictures of a study: which are stacked, their order and their names. Sessions from
// before such stacks find their series.
#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/controller/find_saved.h"
#include "ui/data/picture_stacks.h"
#include "ui/workspace/hanging_protocol.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* stackUid = "1.2";

// Returns numbered pictures of one size in separate files; without positions if `apartMm` is 0.
Series pictures(const std::vector<int>& numbers, glm::ivec2 size, double apartMm = 0,
                const char* modality = "DX") {
  Series series;
  series.id = series.seriesUid = stackUid;
  series.studyUid = "1";
  series.format = "DICOM";
  series.modality = modality;
  series.path = "folder";
  series.acquired.size = {size, int(numbers.size())};
  series.acquired.calibrated = apartMm > 0;
  if (apartMm > 0) series.acquired.patientFromVoxelStep[2] = {0, 0, apartMm};
  for (const int number : numbers) {
    const std::string name = std::to_string(number);
    series.files.push_back("folder/" + name + ".dcm");
    series.frames.push_back(0);
    series.sopInstanceUids.push_back("1.2.3." + name);
    series.orders.push_back({number, {}});
  }
  return series;
}

Image colourImage(int number, const std::string& file, int frames = 1, const std::string& time = {}) {
  Image image;
  image.seriesUid = stackUid, image.studyUid = "1", image.modality = "US";
  image.path = "folder/" + file;
  image.sopInstanceUid = "1.2.3." + file;
  image.notVolume = "Colour.";
  image.photometric = "RGB";
  image.frames = frames;
  image.columns = 40, image.rows = 30;
  image.order = {number, time};
  return image;
}

QString filesOf(const Series& series) {
  QStringList names;
  for (std::size_t n = 0; n < series.files.size(); ++n) {
    const QString file = QString::fromStdString(series.files[n]).section(u'/', -1).section(u'.', 0, 0);
    names << (series.frames[n] > 0 ? file + u'/' + QString::number(series.frames[n]) : file);
  }
  return names.join(u' ');
}

// Returns "volumes | frames", each as "files; files".
QString said(const Study& study) {
  const auto all = [](const std::vector<Series>& some) {
    QStringList texts;
    for (const Series& series : some) texts << filesOf(series);
    return texts.join(QStringLiteral("; "));
  };
  return all(study.volumes) + QStringLiteral(" | ") + all(frameSeries(study));
}

// Returns pictures of two sizes whose paths have another order than their numbers.
Study twoSizes() {
  Study study;
  study.volumes = {pictures({1, 10}, {60, 80}), pictures({2}, {90, 120})};
  study.volumes[1].id += "#2";
  setProjections(study.volumes[0], {{"R", "CC"}, {"L", "CC"}});
  study.volumes[1].laterality = "R", study.volumes[1].viewPosition = "MLO";
  return study;
}

SavedSeries savedAs(const Series& series) { return {series, {}, {}, proofOf(series)}; }

}  // namespace

class TestPictureStacks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsStacked_data();
  void whatIsStacked();
  void picturesKeepWhatTheyAre();
  void framesStandInOrder_data();
  void framesStandInOrder();
  void aNameStandsForTheSameFrames();
  void memoryIsForTheLargest();
  void leftOutFilesAreTold();
  void sessionsFindWhatTheyKnew();
  void twoOfAStackAreHung();
  void moreThanOneBeginWithTheStack();
};

void TestPictureStacks::whatIsStacked_data() {
  QTest::addColumn<Study>("study");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* name, const std::vector<Series>& volumes, const char* expected,
                      const std::vector<Image>& images = {}) {
    Study study;
    study.volumes = volumes;
    study.images = images;
    QTest::newRow(name) << study << QString::fromLatin1(expected);
  };
  const auto changed = [](Series series, const std::function<void(Series&)>& change) {
    change(series);
    return series;
  };
  const auto turned = [&](const Series& series) {
    return changed(series, [](Series& s) {
      s.acquired.patientFromVoxelStep = {{0, 1, 0}, {0, 0, -1}, {s.acquired.spacing().z, 0, 0}};
    });
  };
  const Series one = pictures({1}, {60, 80}), three = pictures({1, 3, 4}, {60, 80});
  const Series other = pictures({2}, {90, 120});
  const Series scout = pictures({1}, {60, 80}, 1, "CT");
  row("two sizes", {three, other}, " | 1 2 3 4");
  row("one size is a series as it is", {three}, "1 3 4 | ");
  row("a grey and a colour picture", {one}, " | 1 2", {colourImage(2, "2.dcm")});
  row("five of one size and one of another", {pictures({1, 2, 3, 5, 6}, {60, 80}), pictures({4}, {9, 9})},
      " | 1 2 3 4 5 6");
  row("two series", {one, changed(other, [](Series& s) { s.seriesUid = "1.3"; })}, "1; 2 | ");
  row("two studies", {one, changed(other, [](Series& s) { s.studyUid = "2"; })}, "1; 2 | ");
  row("files without a series",
      {changed(one, [](Series& s) { s.seriesUid.clear(); }),
       changed(other, [](Series& s) { s.seriesUid.clear(); })},
      "1; 2 | ");
  row("localizers",
      {pictures({1, 2, 3, 4, 5}, {9, 9}, 15, "MR"), turned(pictures({6, 7, 8}, {9, 9}, 15, "MR"))},
      " | 1 2 3 4 5 6 7 8");
  row("a scout from two sides", {scout, turned(pictures({2}, {60, 80}, 1, "CT"))}, " | 1 2");
  row("scouts of two sizes", {scout, pictures({2}, {60, 90}, 1, "CT")}, " | 1 2");
  row("slices with a gap", {pictures({1, 2}, {9, 9}, 5, "CT"), pictures({3, 4, 5}, {9, 9}, 5, "CT")},
      "1 2; 3 4 5 | ");
  row("and a colour picture", {pictures({1, 2}, {9, 9}, 5, "CT")}, "1 2 | 3", {colourImage(3, "3.dcm")});
  row("localizers in two frames of reference",
      {scout,
       changed(turned(pictures({2}, {60, 80}, 1, "CT")), [](Series& s) { s.frameOfReferenceUid = "1.9"; })},
      "1; 2 | ");
  row("radiographs that name frames of reference",
      {one, changed(other, [](Series& s) { s.frameOfReferenceUid = "1.9"; })}, " | 1 2");
  row("a radiograph among slices in two frames of reference",
      {changed(pictures({3}, {60, 80}), [](Series& s) { s.frameOfReferenceUid = "1.9"; }), scout,
       turned(pictures({2}, {60, 80}, 1, "CT"))},
      "3; 1; 2 | ");
  row("two patients of one series", {one, changed(other, [](Series& s) { s.patientId = "8"; })}, "1; 2 | ");
  row("two names", {one, changed(other, [](Series& s) { s.patientName = "Roe"; })}, "1; 2 | ");
  row("two birth dates", {one, changed(other, [](Series& s) { s.patientBirthDate = "19500101"; })},
      "1; 2 | ");
  row("a UID for two", {one, changed(other, [](Series& s) { s.sopInstanceUids = {"1.2.3.1"}; })}, "1; 2 | ");
  row("no UID", {one, changed(other, [](Series& s) { s.sopInstanceUids = {""}; })}, "1; 2 | ");
  Image ofAnother = colourImage(2, "2.dcm");
  ofAnother.patientId = "8";
  row("a colour picture of another patient", {one}, "1 | 2", {ofAnother});
  row("a localizer of a volume", {pictures({1}, {9, 9}, 1, "CT"), pictures({2, 3, 4, 5}, {9, 9}, 1, "CT")},
      "1; 2 3 4 5 | ");
  row("slices without a place", {pictures({1}, {8, 8}, 0, "CT"), pictures({2, 3, 4, 5}, {9, 9}, 0, "CT")},
      "1; 2 3 4 5 | ");
  row("echoes",
      {changed(one,
               [](Series& s) {
                 s.splitBy = {{"EchoTime", "20", "TE 20 ms"}};
               }),
       changed(other,
               [](Series& s) {
                 s.splitBy = {{"EchoTime", "40", "TE 40 ms"}};
               })},
      "1; 2 | ");
  row("PET", {pictures({1}, {8, 8}, 4, "PT"), pictures({2}, {9, 9}, 4, "PT")}, "1; 2 | ");
  row("a file of two frames",
      {changed(pictures({1, 1}, {8, 8}),
               [](Series& s) {
                 s.frames = {0, 1};
               }),
       other},
      "1 1/1; 2 | ");
  row("another format", {changed(one, [](Series& s) { s.format = "NRRD"; }), other}, "1; 2 | ");
}

void TestPictureStacks::whatIsStacked() {
  QFETCH(Study, study);
  QFETCH(QString, expected);
  const Study stacked = withPictureStacks(study);
  QCOMPARE(said(stacked), expected);
  QCOMPARE(said(withPictureStacks(stacked)), expected);
}

void TestPictureStacks::picturesKeepWhatTheyAre() {
  const Study study = withPictureStacks(twoSizes());
  QCOMPARE(study.images.size(), std::size_t(3));
  const std::vector<Series> all = frameSeries(study);
  QCOMPARE(all.size(), std::size_t(1));
  const Series& stack = all.front();
  QCOMPARE(filesOf(stack), QStringLiteral("1 2 10"));
  QCOMPARE(stack.sopInstanceUids, (std::vector<std::string>{"1.2.3.1", "1.2.3.2", "1.2.3.10"}));
  const ProjectionView expected[] = {{"R", "CC"}, {"R", "MLO"}, {"L", "CC"}};
  for (int n = 0; n < 3; ++n) QVERIFY(projectionOf(stack, n) == expected[n]);
  QVERIFY(opensAsFrames(stack) && isOfProjections(stack));
  QCOMPARE(stack.studyUid, std::string("1"));
  QCOMPARE(stack.modality, std::string("DX"));
}

void TestPictureStacks::framesStandInOrder_data() {
  QTest::addColumn<std::vector<Image>>("images");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* name, const std::vector<Image>& images, const char* expected) {
    QTest::newRow(name) << images << QString::fromLatin1(expected);
  };
  row("by number", {colourImage(10, "a"), colourImage(9, "b"), colourImage(2, "c")}, "c b a");
  row("then by time", {colourImage(1, "a", 1, "120001"), colourImage(1, "b", 1, "115959.5")}, "b a");
  row("then by UID", {colourImage(1, "b"), colourImage(1, "a")}, "a b");
  row("clips stay whole", {colourImage(3, "a"), colourImage(2, "b", 3), colourImage(1, "c", 2)},
      "c c/1 b b/1 b/2 a");
}

void TestPictureStacks::framesStandInOrder() {
  QFETCH(std::vector<Image>, images);
  QFETCH(QString, expected);
  Study study;
  study.images = images;
  QCOMPARE(filesOf(frameSeries(study).front()), expected);
}

void TestPictureStacks::aNameStandsForTheSameFrames() {
  Study study;
  study.images = {colourImage(1, "a"), colourImage(2, "b")};
  const Series inOrder = frameSeries(study).front();
  QCOMPARE(inOrder.id, std::string("1.2#frames"));
  QVERIFY(frameSeriesOfPaths(study).front() == inOrder);
  study.images[0].order.instance = 3;
  const Series turned = frameSeries(study).front(), ofPaths = frameSeriesOfPaths(study).front();
  QCOMPARE(turned.id, std::string("1.2#pictures"));
  QCOMPARE(filesOf(turned), QStringLiteral("b a"));
  QCOMPARE(ofPaths.id, std::string("1.2#frames"));
  QCOMPARE(filesOf(ofPaths), QStringLiteral("a b"));
  // Pictures that formed a volume before stacks existed are not among their frames.
  study.volumes = {pictures({4}, {60, 80})};
  study = withPictureStacks(study);
  QCOMPARE(frameSeries(study).front().id, std::string("1.2#pictures"));
  QCOMPARE(filesOf(frameSeriesOfPaths(study).front()), QStringLiteral("a b"));
  QVERIFY(frameSeriesOfPaths(withPictureStacks(twoSizes())).empty());
}

// A worker gets memory for this size to read one of them.
void TestPictureStacks::memoryIsForTheLargest() {
  Study study;
  study.images = {colourImage(1, "a"), colourImage(2, "b")};
  study.images[1].columns = 20, study.images[1].rows = 70;
  QCOMPARE(frameSeries(study).front().acquired.size, glm::ivec3(40, 70, 2));
}

void TestPictureStacks::leftOutFilesAreTold() {
  Study study = twoSizes();
  const auto lost = [](const char* path, bool beside) {
    Unread unread;
    unread.path = path, unread.reason = "why", unread.beside = beside;
    return unread;
  };
  study.refused = {{"folder/known", "why"}};
  study.other = {{"folder/report", "a report"}};
  study.volumes[0].unread = {lost("folder/known", false), lost("folder/report", false),
                             lost("folder/left", false), lost("folder/beside", true)};
  study.volumes[1].unread = {lost("folder/left", false)};
  const Study stacked = withPictureStacks(study);
  QCOMPARE(stacked.refused.size(), std::size_t(2));
  QCOMPARE(stacked.refused[1].path, std::string("folder/left"));
}

void TestPictureStacks::sessionsFindWhatTheyKnew() {
  Study study = twoSizes();
  study.images = {colourImage(5, "a"), colourImage(4, "b")};
  const std::vector<Series> known = allSeriesOf(study);
  std::vector<Series> saved = study.volumes;
  saved.push_back(frameSeriesOfPaths(study).front());              // as an old session has it
  saved.push_back(frameSeries(withPictureStacks(study)).front());  // as a new session has it
  for (const Series& series : saved) {
    const Series* found = findSaved(known, savedAs(series));
    QVERIFY2(found, series.id.c_str());
    QCOMPARE(found->id, series.id);
    QCOMPARE(found->sopInstanceUids, series.sopInstanceUids);
  }
  QCOMPARE(filesOf(saved[2]), QStringLiteral("a b"));
  QCOMPARE(filesOf(saved[3]), QStringLiteral("1 2 b a 10"));
}

void TestPictureStacks::twoOfAStackAreHung() {
  Study study;
  study.volumes = {pictures({1}, {60, 80}), pictures({2}, {90, 120})};
  const std::vector<Series> stacks = frameSeries(withPictureStacks(study));
  QCOMPARE(stacks.size(), std::size_t(1));
  const std::vector<SeriesPicture> single = picturesOf({&stacks[0]});
  QCOMPARE(single.size(), std::size_t(2));
  const KnownProtocols known = knownProtocols();
  const HangingProtocol& two = protocolNamed(known, "Two X-ray pictures");
  const PatientStudies studies = studiesAround({&stacks[0]}, stacks[0]);
  const std::vector<SeriesPicture> cells = picturesOfCells(two, studies);
  QVERIFY(cells == single);
  QVERIFY(pictureIn(hung({}, two, studies), firstComparedId + 1).frame == 1);
}

void TestPictureStacks::moreThanOneBeginWithTheStack() {
  const std::vector<Series> stacks = frameSeries(withPictureStacks(twoSizes()));
  QVERIFY(largerStack(pictures({1, 2}, {60, 80}), stacks) == &stacks[0]);
  QVERIFY(!largerStack(pictures({1, 2, 3}, {60, 80}), stacks));
  QVERIFY2(!largerStack(pictures({1, 2, 3, 4}, {60, 80}, 1, "CT"), stacks), "a volume");
}

VOLUMEN_TEST(TestPictureStacks);
#include "tst_picture_stacks.moc"
