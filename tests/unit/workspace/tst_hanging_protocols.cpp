// Guards the language of hanging protocols and its refusals: every field, words that describe series,
// built-in and user protocols, and the example of their page.
#include <QFile>
#include <QTemporaryDir>
#include <set>

#include "io/files/preset_files.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

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
  void noneIsNoAgent();
  void fastSpinEchoIsNoFatSaturation();
  void thoseOfTheProgramAreRead();
  void anOwnOneHidesThatOfItsName();
  void theExampleOfTheDocumentIsRead();
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
  QTest::addColumn<int>("weighting");  // -1 if unknown; the kernel for CT
  QTest::addColumn<int>("contrast");   // -1 if not stated
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

// A study is split by agent if some series have one and others state that they have none.
void TestHangingProtocols::noneIsNoAgent() {
  for (const auto& [agent, isGiven] : {std::pair("IOHEXOL 350", true), {"NONE", false}, {"No", false}}) {
    Series series;
    series.description = "Chest";
    series.contrastAgent = agent;
    series.splitBy = {{"ContrastBolusAgent", agent, {}}};
    QVERIFY2(namesContrast(series) == isGiven, agent);
    QVERIFY2(contrastOf(series).value_or(false) == isGiven, agent);
  }
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

VOLUMEN_TEST(TestHangingProtocols);
#include "tst_hanging_protocols.moc"
