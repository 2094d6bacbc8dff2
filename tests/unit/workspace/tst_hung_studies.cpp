// Guards how hanging protocols hang studies: the protocol that fits a study, the series in each cell, and
// what a kept protocol stores. In random cases, any protocol makes a workspace that a session can hold.
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

QStringList namesOf(const std::vector<HangingProtocol>& all, const std::vector<std::size_t>& numbers) {
  QStringList names;
  for (const std::size_t n : numbers) names << QString::fromStdString(all[n].name);
  return names;
}

// Returns what each cell shows: side and view, or the description; "-" for empty cells.
QStringList cellsOf(const HangingProtocol& protocol, const PatientStudies& studies) {
  QStringList cells;
  for (const SeriesPicture& picture : picturesOfCells(protocol, studies)) {
    const Series* s = picture.series;
    const ProjectionView view = s ? projectionOf(*s, picture.frame) : ProjectionView();
    const std::string text = !s ? "-"
                             : view.viewPosition.empty()
                                 ? s->description
                                 : view.laterality + view.viewPosition + s->studyDate.substr(2, 2);
    cells << QString::fromStdString(text);
  }
  return cells;
}

}  // namespace

class TestHungStudies : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void studiesAreOffered_data();
  void studiesAreOffered();
  void cellsHoldTheirSeries_data();
  void cellsHoldTheirSeries();
  void aStudyIsHung();
  void oneSeriesHasTwoWindows();
  void aStackIsHungByItsPictures();
  void emptyCellsSayWhatTheyWant();
  void whatIsShownIsAProtocol();
  void twinsAreKeptByTheirRank();
  void anyProtocolMakesASession();
};

void TestHungStudies::studiesAreOffered_data() {
  QTest::addColumn<std::vector<HangSeries>>("series");
  QTest::addColumn<QStringList>("names");  // names of the protocols, best first
  const auto row = [](const char* name, const std::vector<HangSeries>& series, const QStringList& names) {
    QTest::newRow(name) << series << names;
  };
  const QString four = QStringLiteral("Mammograms"), cc = QStringLiteral("Mammograms, CC"),
                mlo = QStringLiteral("Mammograms, MLO"),
                before = QStringLiteral("Mammograms with those before");
  row("four mammograms", fourBreasts, {four, cc, mlo});
  std::vector<HangSeries> withPrior = fourBreasts;
  withPrior.push_back(mammogramOf("R", "CC", "20240101"));
  row("and one of before", withPrior, {before, four, cc, mlo});
  std::vector<HangSeries> withUltrasound = fourBreasts;
  withUltrasound.push_back({"US", "Breast", "BREAST", "", "", "20250601"});
  row("and an ultrasound of before", withUltrasound, {four, cc, mlo});
  row("one mammogram", {mammogramOf("R", "CC")}, {});
  row("a brain", brainSeries, {QStringLiteral("MR brain"), QStringLiteral("MR, series by number")});
  row("a chest, two views", {xRayOf("LL"), xRayOf("PA")},
      {QStringLiteral("Frontal and lateral"), QStringLiteral("Two X-ray pictures")});
  row("a hand without view positions", {xRayOf(""), xRayOf("")}, {QStringLiteral("Two X-ray pictures")});
  row("three X-ray pictures", {xRayOf(""), xRayOf(""), xRayOf("")}, {});
  row("a chest and one of before", {xRayOf("PA"), xRayOf("PA", "20250101")},
      {QStringLiteral("X-ray pictures with those before")});
  row("a document", {{"SR", "Report"}}, {});
}

void TestHungStudies::studiesAreOffered() {
  QFETCH(std::vector<HangSeries>, series);
  QFETCH(QStringList, names);
  const KnownProtocols known = knownProtocols();
  QCOMPARE(namesOf(known.protocols, fitting(known.protocols, OpenPictures(series).studies())), names);
  const QByteArray modality = series.front().modality;
  if ((modality == "MG" || modality == "DX") && series.size() > 1)
    QCOMPARE(namesOf(known.protocols, fitting(known.protocols, OpenPictures::stacked(series).studies())),
             names);
}

void TestHungStudies::cellsHoldTheirSeries_data() {
  QTest::addColumn<QByteArray>("protocol");
  QTest::addColumn<std::vector<HangSeries>>("series");
  QTest::addColumn<QStringList>("cells");
  const auto row = [](const char* name, const char* protocol, const std::vector<HangSeries>& series,
                      const char* cells) {
    QTest::newRow(name) << QByteArray(protocol) << series
                        << QString::fromLatin1(cells).split(QStringLiteral("; "));
  };
  row("four mammograms", "Mammograms", fourBreasts, "RCC26; LCC26; RMLO26; LMLO26");
  row("three mammograms", "Mammograms", {fourBreasts.begin(), fourBreasts.begin() + 3},
      "RCC26; -; RMLO26; LMLO26");
  std::vector<HangSeries> withPrior = fourBreasts;
  for (const HangSeries& s : {mammogramOf("L", "CC", "20240101"), mammogramOf("R", "CC", "20240101"),
                              mammogramOf("R", "CC", "20220101")})
    withPrior.push_back(s);
  row("with those before", "Mammograms with those before", withPrior,
      "RCC26; LCC26; RMLO26; LMLO26; RCC24; LCC24; -; -");
  std::vector<HangSeries> withUltrasound = fourBreasts;
  withUltrasound.push_back({"US", "Breast", "BREAST", "", "", "20250601"});
  withUltrasound.push_back(mammogramOf("R", "CC", "20240101"));
  row("an ultrasound between is no prior", "Mammograms with those before", withUltrasound,
      "RCC26; LCC26; RMLO26; LMLO26; RCC24; -; -; -");
  row("PA before AP", "X-ray pictures with those before", {xRayOf("PA"), xRayOf("AP", "20250101")},
      "PA26; AP25");
  row("a brain", "MR brain", brainSeries,
      "t2_flair_tra; t2_tse_tra; ep2d_diff_trace; t1_mprage_sag; T1 tse tra +C; ep2d_diff_ADC");
  row("localizers last", "MR, series by number",
      {{"MR", "loc", "", "", "", "20260301", 3}, {"MR", "a"}, {"MR", "b"}}, "a; b; loc; -");
}

void TestHungStudies::cellsHoldTheirSeries() {
  QFETCH(QByteArray, protocol);
  QFETCH(std::vector<HangSeries>, series);
  QFETCH(QStringList, cells);
  const KnownProtocols known = knownProtocols();
  QCOMPARE(cellsOf(protocolNamed(known, protocol.constData()), OpenPictures(series).studies()), cells);
  if (QLatin1String(series.front().modality) != QLatin1String("MG")) return;
  const OpenPictures stacked = OpenPictures::stacked(series);
  QCOMPARE(cellsOf(protocolNamed(known, protocol.constData()), stacked.studies()), cells);
}

void TestHungStudies::aStudyIsHung() {
  const KnownProtocols known = knownProtocols();
  const OpenPictures chest({{"CT", "Soft tissue 1.0", "CHEST"}, {"CT", "Lung 1.0", "CHEST"}});
  SceneLook look;
  look.scene.camera.emplace();
  Workspace before = withSeries({}, sceneViewId, chest.series[0], look);
  before.links.scroll = false;
  const Workspace lung = hung(before, protocolNamed(known, "CT, lung"), chest.studies());
  QVERIFY(lung.layout == Layout::four && lung.links.scroll);
  QCOMPARE(lung.focus, firstComparedId);
  const ViewKind kinds[] = {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal, ViewKind::axial};
  for (int n = 0; n < 4; ++n) {
    const ViewState& view = lung.view(firstComparedId + n);
    QVERIFY(view.kind == kinds[n]);
    QVERIFY(view.series == keyOf(chest.series[1]));
    QCOMPARE(flatLookOf(view).slabMm, n == 3 ? 10. : 0.);
  }
  QVERIFY(lung.series.at(keyOf(chest.series[1])).window == Window({-600, 1500}));
  QVERIFY(!lung.series.at(keyOf(chest.series[0])).window);
  // The 3D view looks as before.
  const Workspace soft = hung(before, protocolNamed(known, "CT, soft tissue"), chest.studies());
  QVERIFY(soft.view(firstComparedId + 3).kind == ViewKind::volume);
  QVERIFY(soft.view(firstComparedId + 3).scenes.at(keyOf(chest.series[0])) == look);
  // Without an earlier 3D view, slices are shown as acquired.
  const Workspace bone = hung({}, protocolNamed(known, "CT, bone"), chest.studies());
  QVERIFY(bone.view(firstComparedId + 3).kind == ViewKind::axial);
}

// If windows of one series differ, each cell has its own. Otherwise the series has the window.
void TestHungStudies::oneSeriesHasTwoWindows() {
  const KnownProtocols known = knownProtocols();
  const HangingProtocol& both = protocolNamed(known, "CT, lung and soft tissue");
  const ViewId left = firstComparedId, right = firstComparedId + 1;
  const auto aloneIn = [](const Workspace& w, ViewId id) { return flatLookOf(w.view(id)).windowAlone; };
  const OpenPictures one({{"CT", "Thorax", "CHEST"}});
  const SeriesKey key = keyOf(one.series[0]);
  const Workspace first = hung({}, both, one.studies());
  QVERIFY(first.view(left).series == key && first.view(right).series == key);
  QVERIFY(aloneIn(first, left) && aloneIn(first, left)->window == Window({-600, 1500}));
  QVERIFY(aloneIn(first, right) && aloneIn(first, right)->window == Window({40, 400}));
  QVERIFY(!first.series.at(key).window);
  const HangingProtocol kept = protocolOf(first, "Mine", one.pictures());
  QVERIFY(kept.cells[0].window == both.cells[0].window && kept.cells[1].window == both.cells[1].window);
  const Workspace again = hung(first, protocolNamed(known, "CT, lung"), one.studies());
  QVERIFY(!aloneIn(again, left) && !aloneIn(again, right));
  QVERIFY(again.series.at(key).window == Window({-600, 1500}));
  // If only one cell states a window, the others use it too.
  HangingProtocol half = kept;
  half.cells[0].window.reset();
  const Workspace halves = hung({}, half, one.studies());
  QVERIFY(!aloneIn(halves, left) && !aloneIn(halves, right));
  QVERIFY(halves.series.at(key).window == Window({40, 400}));
  HangingProtocol equal = kept;
  equal.cells[0].window = equal.cells[1].window;
  const Workspace equals = hung({}, equal, one.studies());
  QVERIFY(!aloneIn(equals, left) && equals.series.at(key).window == Window({40, 400}));
  // Beside two cells with different windows, a cell without one shows the series' own.
  HangingProtocol three = kept;
  three.layout = Layout::four;
  three.cells.push_back(three.cells[0]);
  three.cells[2].window.reset();
  const Workspace thirds = hung({}, three, one.studies());
  QVERIFY(aloneIn(thirds, left) && aloneIn(thirds, right) && !aloneIn(thirds, right + 1));
  QVERIFY(!thirds.series.at(key).window);
  // One CT view is beside the CT under the PET.
  const OpenPictures fused({{"PT", "PET"}, {"CT", "CT"}});
  const Workspace petCt = hung({}, protocolNamed(known, "PET/CT"), fused.studies());
  QVERIFY(petCt.view(left).series == petCt.view(right).series);
  QVERIFY(!aloneIn(petCt, left) && !aloneIn(petCt, right));
  QVERIFY(petCt.series.at(keyOf(fused.series[1])).window == Window({40, 400}));
  // Two kernels are two series.
  const OpenPictures two({{"CT", "Soft tissue 1.0", "CHEST"}, {"CT", "Lung 1.0", "CHEST"}});
  const Workspace kernels = hung({}, both, two.studies());
  QVERIFY(!aloneIn(kernels, left) && !aloneIn(kernels, right));
  QVERIFY(kernels.series.at(keyOf(two.series[1])).window == Window({-600, 1500}));
  QVERIFY(kernels.series.at(keyOf(two.series[0])).window == Window({40, 400}));
}

// A cell of a stack shows its picture as acquired.
void TestHungStudies::aStackIsHungByItsPictures() {
  const KnownProtocols known = knownProtocols();
  const OpenPictures stacked = OpenPictures::stacked(fourBreasts);
  QCOMPARE(stacked.series.size(), std::size_t(1));
  const Workspace after = hung({}, protocolNamed(known, "Mammograms"), stacked.studies());
  const int frames[] = {1, 3, 2, 0};
  for (int n = 0; n < 4; ++n) {
    const ViewState& view = after.view(firstComparedId + n);
    QVERIFY(view.series == keyOf(stacked.series[0]) && showsFrames(view.kind));
    QCOMPARE(flatLookOf(view).frame, frames[n]);
  }
  QVERIFY2(opensAsPictures(stacked.series[0]), "pictures of two sides are no volume");
}

void TestHungStudies::emptyCellsSayWhatTheyWant() {
  const KnownProtocols known = knownProtocols();
  const OpenPictures three({fourBreasts.begin(), fourBreasts.begin() + 3});
  Workspace after = hung({}, protocolNamed(known, "Mammograms"), three.studies());
  QCOMPARE(after.view(firstComparedId + 1).wanted, std::string("L CC"));
  QVERIFY(after.view(firstComparedId + 1).series.empty());
  QVERIFY(showsFrames(after.view(firstComparedId).kind));
  QVERIFY(after.view(firstComparedId).wanted.empty());
  after = withFrames(after, firstComparedId + 1, madeFor(mammogramOf("L", "CC"), 9));
  QVERIFY2(after.view(firstComparedId + 1).wanted.empty(), "there it is");
}

void TestHungStudies::whatIsShownIsAProtocol() {
  const KnownProtocols known = knownProtocols();
  const std::pair<const char*, std::vector<HangSeries>> cases[] = {
      {"Mammograms", fourBreasts},
      {"MR brain", brainSeries},
      {"Frontal and lateral", {xRayOf("PA"), xRayOf("LL")}}};
  std::vector<std::pair<const char*, OpenPictures>> all{
      {"Mammograms", OpenPictures::stacked(fourBreasts)},
      {"Frontal and lateral", OpenPictures::stacked(cases[2].second)}};
  for (const auto& [name, series] : cases) all.emplace_back(name, OpenPictures(series));
  for (const auto& [name, open] : all) {
    const Workspace first = hung({}, protocolNamed(known, name), open.studies());
    const HangingProtocol kept = protocolOf(first, "Mine", open.pictures(), &protocolNamed(known, name));
    const Result<HangingProtocol> read = protocolFromJson(protocolToJson(kept));
    QVERIFY2(read && *read == kept, name);
    QCOMPARE(fitting({kept}, open.studies()).size(), std::size_t(1));
    const HangingProtocol& model = protocolNamed(known, name);
    QVERIFY2(kept.sameScale == model.sameScale, name);
    for (std::size_t n = 0; n < model.cells.size(); ++n)
      QVERIFY2(kept.cells[n].chestWall == model.cells[n].chestWall, name);
    const Workspace again = hung({}, kept, open.studies());
    QVERIFY2(again.layout == first.layout && again.links == first.links, name);
    for (const ViewId id : viewsOnScreen(first)) {
      QVERIFY2(again.view(id).series == first.view(id).series, name);
      QVERIFY2(again.view(id).kind == first.view(id).kind, name);
      QVERIFY2(flatLookOf(again.view(id)) == flatLookOf(first.view(id)), name);
    }
  }
}

// Two series cannot be distinguished by any rule, and the second one comes first. One is a prior, and one is
// of another patient.
void TestHungStudies::twinsAreKeptByTheirRank() {
  OpenPictures open({{"MR", "T2"},
                     {"MR", "T2"},
                     {"MR", "T2", "", "", "", "20250301"},
                     {"MR", "T2", "", "", "", "20251201"}});
  Series& other = open.series[3];
  other.patientId = "8", other.patientName = "Roe^Jane";
  Workspace shown;
  shown.layout = Layout::four;
  const std::size_t order[] = {1, 0, 2, 3};
  for (int n = 0; n < 4; ++n)
    shown = withSeries(std::move(shown), firstComparedId + n, open.series[order[n]], {});
  shown.focus = firstComparedId;
  const HangingProtocol kept = protocolOf(shown, "Twins", open.pictures());
  QCOMPARE(kept.series.size(), std::size_t(2));
  QCOMPARE(kept.cells[0].which, 2);
  QCOMPARE(kept.cells[1].which, 1);
  QCOMPARE(kept.cells[1].series, kept.cells[0].series);
  QCOMPARE(kept.series[1].prior, 1);
  QVERIFY2(kept.cells[3].series.empty(), "another patient");
  const Workspace again = hung({}, kept, open.studies());
  for (int n = 0; n < 3; ++n) QVERIFY(again.view(firstComparedId + n).series == keyOf(open.series[order[n]]));
  // A window that no protocol can hold is left out.
  shown.series.edit(keyOf(open.series[0])).window = Window{0, 1e12};
  shown.series.edit(keyOf(open.series[1])).window = Window{40, 400};
  const HangingProtocol windows = protocolOf(shown, "Windows", open.pictures());
  QVERIFY(windows.cells[0].window == Window({40, 400}) && !windows.cells[1].window);
  QVERIFY(protocolFromJson(protocolToJson(windows)));
  const KnownProtocols known = knownProtocols();
  const OpenPictures breasts(fourBreasts);
  const HangingProtocol& four = protocolNamed(known, "Mammograms");
  Workspace moved = hung({}, four, breasts.studies());
  // A moved mammogram no longer faces its neighbour.
  moved = withFrames(std::move(moved), firstComparedId, breasts.series[0]);
  const HangingProtocol keptMoved = protocolOf(moved, "Moved", breasts.pictures(), &four);
  QVERIFY(keptMoved.cells[0].chestWall == ChestWall::anywhere && !keptMoved.sameScale);
  QVERIFY(keptMoved.cells[1].chestWall == ChestWall::left);
}

// Hangs protocols one after another over the same workspace.
void TestHungStudies::anyProtocolMakesASession() {
  const Seeds seeds = seedsOf(60, 600);
  const KnownProtocols known = knownProtocols();
  const char* modalities[] = {"CT", "MR", "MG", "DX", "PT", "US"};
  const char* words[] = {"T1", "T2 FLAIR", "Soft", "Lung", "PD", ""};
  const char* views[] = {"CC", "MLO", "PA", "LL", ""};
  const char* sides[] = {"L", "R", ""};
  const char* days[] = {"20260301", "20250301", "20240301"};
  const char* parts[] = {"BRAIN", "KNEE", "CHEST", ""};
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    std::vector<HangSeries> all;
    for (int n = 1 + chance.below(12); n > 0; --n)
      all.push_back({modalities[chance.below(6)], words[chance.below(6)], parts[chance.below(4)],
                     sides[chance.below(3)], views[chance.below(5)], days[chance.below(3)],
                     1 + chance.below(9)});
    const OpenPictures open(all);
    Workspace workspace = withFrames({}, sceneViewId, open.series[0]);
    for (int step = 0; step < 6; ++step) {
      const PatientStudies studies = open.studies(std::size_t(chance.below(int(all.size()))));
      HangingProtocol protocol = known.protocols[std::size_t(chance.below(int(known.protocols.size())))];
      for (ProtocolCell& cell : protocol.cells) cell.picture = CellPicture(chance.below(6));
      workspace = hung(workspace, protocol, studies);
      const QByteArray where = QByteArrayLiteral("seed ") + QByteArray::number(seed);
      const std::vector<ViewId> shown = viewsOnScreen(workspace);
      QVERIFY2(std::ranges::find(shown, workspace.focus) != shown.end(), where.constData());
      QCOMPARE(workspace.views.size(), std::size_t(viewCount));
      for (const ViewId id : shown) {
        const SeriesKey& key = workspace.view(id).series;
        QVERIFY2(key.empty() || workspace.series.contains(key), where.constData());
        QVERIFY2(key.empty() || workspace.view(id).wanted.empty(), where.constData());
      }
      const auto text = sessionToJson(workspace, "/data");
      QVERIFY2(text, where.constData());
      const auto back =
          sessionFromJson(*text, [&](const SavedSeries& saved) -> std::shared_ptr<const Series> {
            return workspace.series.at(keyOf(saved.series)).series;
          });
      QVERIFY2(back && back->workspace == workspace, where.constData());
      const Result<HangingProtocol> kept =
          protocolFromJson(protocolToJson(protocolOf(workspace, "Kept", open.pictures())));
      QVERIFY2(kept, kept ? "" : kept.message().c_str());
    }
  }
}

VOLUMEN_TEST(TestHungStudies);
#include "tst_hung_studies.moc"
