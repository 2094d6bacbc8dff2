// Guards hanging protocols: the language and its refusals, which protocol fits which study, what stands in
// which cell; by chance, that any protocol makes a workspace that a session can hold; those of the program.
#include <QFile>
#include <QTemporaryDir>
#include <map>
#include <set>

#include "io/files/preset_files.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/data/frame_series.h"
#include "ui/workspace/own_protocols.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using volumen::tests::Chance;

namespace {

// A series of a study of one patient.
struct HangSeries {
  const char *modality, *description;
  const char *part = "", *laterality = "", *view = "";
  const char* day = "20260301";
  int slices = 20;
};

Series madeFor(const HangSeries& s, int number) {
  Series series;
  series.modality = s.modality, series.description = s.description, series.bodyPart = s.part;
  series.laterality = s.laterality, series.viewPosition = s.view;
  series.studyDate = s.day, series.studyUid = std::string("1.2.") + s.day;
  series.patientId = "7", series.patientName = "Doe^Jane", series.format = "DICOM";
  series.seriesNumber = std::to_string(number);
  series.id = series.studyUid + "." + series.seriesNumber, series.seriesUid = series.id;
  series.path = "/data/" + series.id;
  series.frameOfReferenceUid = series.studyUid + ".1";
  series.acquired.size = {64, 64, s.slices};
  series.acquired.calibrated = s.slices > 1;
  series.unit = series.modality == "CT" ? "HU" : "";
  series.files.assign(std::size_t(s.slices), series.path + "/1");
  series.frames.assign(std::size_t(s.slices), 0);
  return series;
}

struct OpenPictures {
  std::vector<Series> series;

  explicit OpenPictures(const std::vector<HangSeries>& all) {
    for (const HangSeries& s : all) series.push_back(madeFor(s, int(series.size()) + 1));
  }
  // The same as one series a day.
  static OpenPictures stacked(const std::vector<HangSeries>& all) {
    std::map<std::string, std::vector<HangSeries>> byDay;
    for (const HangSeries& s : all) byDay[s.day].push_back(s);
    OpenPictures open({});
    for (auto day = byDay.rbegin(); day != byDay.rend(); ++day) {
      HangSeries whole = day->second.front();
      whole.slices = int(day->second.size());
      Series& stack = open.series.emplace_back(madeFor(whole, int(open.series.size()) + 1));
      stack.acquired.calibrated = false;
      std::vector<ProjectionView> views;
      for (std::size_t n = 0; n < day->second.size(); ++n) {
        stack.files[n] = std::to_string(n);
        views.push_back({day->second[n].laterality, day->second[n].view});
      }
      setProjections(stack, views);
    }
    return open;
  }
  std::vector<const Series*> pictures() const {
    std::vector<const Series*> all;
    for (const Series& s : series) all.push_back(&s);
    return all;
  }
  PatientStudies studies(std::size_t current = 0) const { return studiesAround(pictures(), series[current]); }
};

HangSeries mammogramOf(const char* side, const char* view, const char* day = "20260301") {
  return {"MG", "MAMMO", "BREAST", side, view, day, 1};
}
HangSeries xRayOf(const char* view, const char* day = "20260301") {
  return {"DX", "Chest", "CHEST", "", view, day, 1};
}

const std::vector<HangSeries> fourBreasts{mammogramOf("L", "MLO"), mammogramOf("R", "CC"),
                                          mammogramOf("R", "MLO"), mammogramOf("L", "CC")};
const std::vector<HangSeries> brainSeries{{"MR", "t1_mprage_sag"},
                                          {"MR", "t2_tse_tra", "BRAIN"},
                                          {"MR", "t2_flair_tra"},
                                          {"MR", "ep2d_diff_trace"},
                                          {"MR", "ep2d_diff_ADC"},
                                          {"MR", "T1 tse tra +C"},
                                          {"MR", "localizer", "", "", "", "20260301", 3}};

QStringList namesOf(const std::vector<HangingProtocol>& all, const std::vector<std::size_t>& numbers) {
  QStringList names;
  for (const std::size_t n : numbers) names << QString::fromStdString(all[n].name);
  return names;
}

const HangingProtocol& protocolNamed(const KnownProtocols& known, const char* name) {
  for (const HangingProtocol& protocol : known.protocols)
    if (protocol.name == name) return protocol;
  qFatal("no protocol %s", name);
}

// What each cell shows: side and view, or the description; "-" of empty ones.
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

const char* const wholeProtocol = R"({
 "name": "All", "when": {"modality": "MR", "bodyPart": "brain|head", "description": "t2", "notDescription": "fs",
  "laterality": "L|R", "viewPosition": "PA", "plane": "axial", "weighting": "T2*", "kernel": "soft",
  "contrast": false, "least": 2, "most": 9, "prior": true},
 "series": [{"name": "a", "modality": "MR", "order": "slices", "prior": 1}, {"name": "b", "like": "a", "prior": 2}],
 "layout": "3x4",
 "cells": [{"series": "a|b", "which": 2, "picture": "coronal", "window": {"centre": 40, "width": -400},
   "over": "b", "slabMm": 12.5, "slabMode": "mean", "inverted": true, "chestWall": "left"}, {}],
 "leastFilled": 0, "links": {"scroll": false, "zoom": true, "pan": true, "window": true},
 "sameScale": true, "automatic": true})";

}  // namespace

class TestHangingProtocols : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyFieldComesBack();
  void refusalsNameTheField_data();
  void refusalsNameTheField();
  void wordsOfSeries_data();
  void wordsOfSeries();
  void fastSpinEchoIsNoFatSaturation();
  void thoseOfTheProgramAreRead();
  void anOwnOneHidesThatOfItsName();
  void theExampleOfTheDocumentIsRead();
  void studiesAreOffered_data();
  void studiesAreOffered();
  void cellsHoldTheirSeries_data();
  void cellsHoldTheirSeries();
  void aStudyIsHung();
  void aStackIsHungByItsPictures();
  void emptyCellsSayWhatTheyWant();
  void whatIsShownIsAProtocol();
  void twinsAreKeptByTheirRank();
  void anyProtocolMakesASession();
};

void TestHangingProtocols::everyFieldComesBack() {
  const Result<HangingProtocol> read = protocolFromJson(wholeProtocol);
  QVERIFY2(read, read ? "" : read.message().c_str());
  QCOMPARE(read->layout.rows, 3);
  QCOMPARE(read->layout.columns, 4);
  QVERIFY(read->when.rule.weighting == Weighting::t2Star);
  QVERIFY(read->cells[0].window == Window({40, -400}));
  QVERIFY(read->cells[0].chestWall == ChestWall::left && read->cells[1] == ProtocolCell());
  const Result<HangingProtocol> again = protocolFromJson(protocolToJson(*read));
  QVERIFY(again && *again == *read);
  HangingProtocol plain;
  plain.name = "plain";
  const Result<HangingProtocol> same = protocolFromJson(protocolToJson(plain));
  QVERIFY(same && *same == plain);
}

void TestHangingProtocols::refusalsNameTheField_data() {
  QTest::addColumn<QByteArray>("from");  // replaced in wholeProtocol
  QTest::addColumn<QByteArray>("to");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* from, const char* to, const char* sentence) {
    QTest::newRow(name) << QByteArray(from) << QByteArray(to) << QString::fromLatin1(sentence);
  };
  row("no JSON", "{", "[", "Not JSON at line");
  row("unknown at the top", "\"sameScale\"", "\"sameScales\"", "sameScales is unknown");
  row("unknown in the condition", "\"least\"", "\"atLeast\"", "when.atLeast is unknown");
  row("unknown in a series", "\"order\"", "\"sort\"", "series[0].sort is unknown");
  row("unknown in a cell", "\"over\"", "\"under\"", "cells[0].under is unknown");
  row("unknown in a link", "\"pan\"", "\"move\"", "links.move is unknown");
  row("no name", "\"All\"", "\"\"", "name must not be empty");
  row("a layout too large", "3x4", "5x4", "layout must be rows and columns, \"1x1\" to \"4x5\"");
  row("another plane", "\"axial\"", "\"oblique\"", "when.plane must be \"axial\" or");
  row("another weighting", "T2*", "T3", "when.weighting must be \"T1\" or");
  row("another picture", "\"coronal\"", "\"2D\"", "cells[0].picture must be \"acquired\" or");
  row("a window without width", "-400", "0", "cells[0].window.width must be at least 1e-9 wide");
  row("a window too wide", "-400", "2e9", "cells[0].window.width must be in -1e+09 .. 1e+09");
  row("a window too narrow", "-400", "1e-10", "cells[0].window.width must be at least 1e-9 wide");
  row("a window too far away", "\"centre\": 40", "\"centre\": -1e10", "cells[0].window.centre must be in");
  row("a slab below 0", "12.5", "-1", "cells[0].slabMm must be in 0 .. 1000");
  row("the 0th series", "\"which\": 2", "\"which\": 0", "cells[0].which must be in 1 .. 10");
  row("a series that is not there", "a|b", "a|c", "cells[0].series must be the name of one of the series");
  row("nothing to lie over", "\"over\": \"b\"", "\"over\": \"c\"", "cells[0].over must be the name");
  row("like nothing", "\"like\": \"a\"", "\"like\": \"x\"", "series[1].like must be the name");
  row("like one of the same study", "\"prior\": 2", "\"prior\": 0", "series[1].prior must be 1 or more");
  row("two of one name", "\"name\": \"b\"", "\"name\": \"a\"", "series[0].name is there twice");
  row("a name of two", "\"name\": \"b\"", "\"name\": \"b|c\"", "series[1].name must be a name without");
  row("more cells than the grid", "3x4", "1x1", "cells must be at most 1, as the layout has");
  row("a text for a number", "12.5", "\"12.5\"", "cells[0].slabMm must be a number, not a text");
}

void TestHangingProtocols::refusalsNameTheField() {
  QFETCH(QByteArray, from);
  QFETCH(QByteArray, to);
  QFETCH(QString, sentence);
  QByteArray text = wholeProtocol;
  const int at = int(text.indexOf(from));
  QVERIFY(at >= 0);
  text.replace(at, from.size(), to);
  const Result<HangingProtocol> read = protocolFromJson(text.toStdString());
  QVERIFY(!read);
  QVERIFY2(QString::fromStdString(read.message()).contains(sentence), read.message().c_str());
}

void TestHangingProtocols::wordsOfSeries_data() {
  QTest::addColumn<QByteArray>("modality");
  QTest::addColumn<QByteArray>("description");
  QTest::addColumn<int>("weighting");  // -1: not known; of CT the kernel
  QTest::addColumn<int>("contrast");   // -1: not said
  const auto mr = [](const char* text, std::optional<Weighting> w, int contrast = -1) {
    QTest::newRow(text) << QByteArray("MR") << QByteArray(text) << (w ? int(*w) : -1) << contrast;
  };
  mr("t1_mprage_sag", Weighting::t1);
  mr("AX T1 FLAIR", Weighting::t1);
  mr("T2_FLAIR_tra", Weighting::flair);
  mr("t2_tirm_tra_dark-fluid", Weighting::flair);
  mr("T2W_TSE posterior fossa", Weighting::t2);
  mr("t2*_gre", Weighting::t2Star);
  mr("SWI_Images", Weighting::t2Star);
  mr("ep2d_diff_b0_1000_ADC", Weighting::adc);
  mr("DWI b1000", Weighting::diffusion);
  mr("PD_TSE_SAG FS", Weighting::protonDensity);
  mr("TOF_3D_multi-slab", Weighting::angiography);
  mr("Scout", {});
  mr("T1 SE +C", Weighting::t1, 1);
  mr("T1 post Gd", Weighting::t1, 1);
  mr("T1 native", Weighting::t1, 0);
  mr("T1 pre contrast", Weighting::t1, 0);
  mr("T1 wo contrast", Weighting::t1, 0);
  mr("T1 w/o contrast", Weighting::t1, 0);
  mr("T1 no contrast", Weighting::t1, 0);
  mr("T1 non-contrast", Weighting::t1, 0);
  mr("T1 without Gd", Weighting::t1, 0);
  mr("T1 ohne KM", Weighting::t1, 0);
  mr("T1 vor KM", Weighting::t1, 0);
  mr("T1 kein KM", Weighting::t1, 0);
  mr("T1 nativ", Weighting::t1, 0);
  mr("T1 nach KM", Weighting::t1, 1);
  mr("T1 presat vorne", Weighting::t1);
  mr("SAG T10-L2", {});
  mr("T2 T10-L2", Weighting::t2);
  const auto ct = [](const char* text, std::optional<Kernel> k) {
    QTest::newRow(text) << QByteArray("CT") << QByteArray(text) << (k ? int(*k) : -1) << -1;
  };
  ct("Lung 1.0", Kernel::lung);
  ct("CHEST BONE", Kernel::bone);
  ct("Soft tissue 5.0", Kernel::soft);
  ct("Thorax 5.0", {});
  ct("CT pulmonary angiogram", {});
  ct("Pulm soft tissue", Kernel::soft);
}

void TestHangingProtocols::wordsOfSeries() {
  QFETCH(QByteArray, modality);
  QFETCH(QByteArray, description);
  QFETCH(int, weighting);
  QFETCH(int, contrast);
  Series series;
  series.modality = modality.toStdString(), series.description = description.toStdString();
  const auto w = weightingOf(series);
  const auto k = kernelOf(series);
  const auto c = contrastOf(series);
  if (modality == "CT")
    QCOMPARE(k ? int(*k) : -1, weighting);
  else
    QCOMPARE(w ? int(*w) : -1, weighting);
  QCOMPARE(c ? int(*c) : -1, contrast);
}

void TestHangingProtocols::fastSpinEchoIsNoFatSaturation() {
  const KnownProtocols known = knownProtocols();
  const auto says = [&](const char* name, const char* description) {
    for (const ProtocolSeries& entry : protocolNamed(known, "MR spine").series) {
      if (entry.name != name) continue;
      SeriesRule rule = entry.rule;
      rule.plane.reset();
      const Series series = madeFor({"MR", description}, 1);
      return matches(rule, {&series});
    }
    return false;
  };
  for (const char* plain : {"SAG T2 FSE", "t2_fse_sag"})
    QVERIFY2(says("T2, sagittal", plain) && !says("STIR, sagittal", plain), plain);
  for (const char* saturated : {"SAG T2 FS", "t2_tse_fs_sag", "T2fs sag", "T2 FatSat"})
    QVERIFY2(!says("T2, sagittal", saturated) && says("STIR, sagittal", saturated), saturated);
}

void TestHangingProtocols::thoseOfTheProgramAreRead() {
  const KnownProtocols known = knownProtocols();
  for (const std::string& problem : known.problems) QFAIL(problem.c_str());
  QVERIFY(known.protocols.size() - known.own >= 12);
  std::set<std::string> names;
  for (const HangingProtocol& protocol : known.protocols) {
    QVERIFY2(names.insert(protocol.name).second, protocol.name.c_str());
    const Result<HangingProtocol> again = protocolFromJson(protocolToJson(protocol));
    QVERIFY2(again && *again == protocol, protocol.name.c_str());
    for (const ProtocolCell& cell : protocol.cells) QVERIFY(!cell.series.empty());
  }
}

void TestHangingProtocols::anOwnOneHidesThatOfItsName() {
  const QByteArray before = qgetenv("XDG_CONFIG_HOME");
  const QTemporaryDir config;
  qputenv("XDG_CONFIG_HOME", config.path().toLocal8Bit());
  HangingProtocol mine;
  mine.name = "Mammograms, CC", mine.leastFilled = 3;
  const Status first = writePresetFile("a", protocolToJson(mine), protocolFolder());
  mine.leastFilled = 5;
  const Status second = writePresetFile("b", protocolToJson(mine), protocolFolder());
  const KnownProtocols known = knownProtocols();
  if (before.isEmpty())
    qunsetenv("XDG_CONFIG_HOME");
  else
    qputenv("XDG_CONFIG_HOME", before);
  QVERIFY(first && second);
  QCOMPARE(std::ranges::count(known.protocols, mine.name, &HangingProtocol::name), std::ptrdiff_t(1));
  QCOMPARE(known.own, std::size_t(1));
  QCOMPARE(protocolNamed(known, "Mammograms, CC").leastFilled, 3);
}

void TestHangingProtocols::theExampleOfTheDocumentIsRead() {
  QFile page(QStringLiteral(VOLUMEN_SOURCE_DIR "/resources/docs/protocols.md"));
  QVERIFY(page.open(QIODevice::ReadOnly));
  const QByteArray text = page.readAll(), begin = "```json\n";
  const qsizetype from = text.indexOf(begin) + begin.size();
  const Result<HangingProtocol> read =
      protocolFromJson(text.mid(from, text.indexOf("```", from) - from).toStdString());
  QVERIFY2(read, read ? "" : read.message().c_str());
  QCOMPARE(read->cells.size(), std::size_t(3));
}

void TestHangingProtocols::studiesAreOffered_data() {
  QTest::addColumn<std::vector<HangSeries>>("series");
  QTest::addColumn<QStringList>("names");  // of the protocols, best first
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

void TestHangingProtocols::studiesAreOffered() {
  QFETCH(std::vector<HangSeries>, series);
  QFETCH(QStringList, names);
  const KnownProtocols known = knownProtocols();
  QCOMPARE(namesOf(known.protocols, fitting(known.protocols, OpenPictures(series).studies())), names);
  const bool areMammograms = QLatin1String(series.front().modality) == QLatin1String("MG");
  if (areMammograms && series.size() > 1)
    QCOMPARE(namesOf(known.protocols, fitting(known.protocols, OpenPictures::stacked(series).studies())),
             names);
}

void TestHangingProtocols::cellsHoldTheirSeries_data() {
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

void TestHangingProtocols::cellsHoldTheirSeries() {
  QFETCH(QByteArray, protocol);
  QFETCH(std::vector<HangSeries>, series);
  QFETCH(QStringList, cells);
  const KnownProtocols known = knownProtocols();
  QCOMPARE(cellsOf(protocolNamed(known, protocol.constData()), OpenPictures(series).studies()), cells);
  if (QLatin1String(series.front().modality) != QLatin1String("MG")) return;
  const OpenPictures stacked = OpenPictures::stacked(series);
  QCOMPARE(cellsOf(protocolNamed(known, protocol.constData()), stacked.studies()), cells);
}

void TestHangingProtocols::aStudyIsHung() {
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
  // 3D as it was seen before.
  const Workspace soft = hung(before, protocolNamed(known, "CT, soft tissue"), chest.studies());
  QVERIFY(soft.view(firstComparedId + 3).kind == ViewKind::volume);
  QVERIFY(soft.view(firstComparedId + 3).scenes.at(keyOf(chest.series[0])) == look);
  // Where that is not known, slices as acquired.
  const Workspace bone = hung({}, protocolNamed(known, "CT, bone"), chest.studies());
  QVERIFY(bone.view(firstComparedId + 3).kind == ViewKind::axial);
}

// A cell of a stack shows its picture as acquired.
void TestHangingProtocols::aStackIsHungByItsPictures() {
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

void TestHangingProtocols::emptyCellsSayWhatTheyWant() {
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

void TestHangingProtocols::whatIsShownIsAProtocol() {
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

// Series that no rule tells apart, the second of them first; one of before; and one of somebody else.
void TestHangingProtocols::twinsAreKeptByTheirRank() {
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
  // What was moved faces nobody any more.
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
  moved = withFrames(std::move(moved), firstComparedId, breasts.series[0]);
  const HangingProtocol keptMoved = protocolOf(moved, "Moved", breasts.pictures(), &four);
  QVERIFY(keptMoved.cells[0].chestWall == ChestWall::anywhere && !keptMoved.sameScale);
  QVERIFY(keptMoved.cells[1].chestWall == ChestWall::left);
}

// One after the other over the same workspace.
void TestHangingProtocols::anyProtocolMakesASession() {
  const tests::Seeds seeds = tests::seedsOf(60, 600);
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

VOLUMEN_TEST(TestHangingProtocols);
#include "tst_hanging_protocols.moc"
