// Guards design.md 5, how rays are integrated: in plain steps if matter changes little, else cell by cell.
#include "tests/unit/plan/asked.h"
#include "tests/unit/suite.h"
#include "viewer/plan/rule_lines.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Sets a faint rise of opacity over all values, which rise by 900 a voxel, and extinction by 0.0045. Light is
// at most 1.1 times as bright as white.
void evenMatter(Asked& a) {
  a.scene.transferFunction.points = {{-1000, {}, 0}, {1000, {}, 0.01}};
  a.facts.gradientBounds.assign(256, 900);
}

// Returns the statement of a level that integrates cell by cell: its ray budget, `figures` and `words`.
std::string cellByCell(Quality quality, const std::string& figures = "", const std::string& words = "") {
  return "on " + inDigits(levelOf(quality).rayBudget) + "/255 " + figures + " cell " + words;
}

}  // namespace

Q_DECLARE_METATYPE(PilotFinding)

class TestIntegrationRule : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theRuleSaysWhatAndWhy_data();
  void theRuleSaysWhatAndWhy();
  void stepsAreLeftOpenWhereTheyMayPay_data();
  void stepsAreLeftOpenWhereTheyMayPay();
  void whatAPilotFoundIsSaid_data();
  void whatAPilotFoundIsSaid();
};

void TestIntegrationRule::theRuleSaysWhatAndWhy_data() {
  addRuleColumns();
  const auto row = addRuleRow;
  const std::string atStandard = cellByCell(Quality::standard), atHigh = cellByCell(Quality::high),
                    atExact = cellByCell(Quality::exact);
  const char *standard = atStandard.c_str(), *high = atHigh.c_str(), *exact = atExact.c_str();
  row("standard", "integration", standard, [](Asked&) {});
  row("high", "integration", high, [](Asked& a) { a.options.quality = Quality::high; });
  row("exact", "integration", exact, [](Asked& a) { a.options.quality = Quality::exact; });
  row("a step in the curve changes nothing", "integration", standard,
      [](Asked& a) { a.scene.transferFunction.points[1].value = 151; });
  row("a tolerance as asked", "integration", "on 128/255 cell asked",
      [](Asked& a) { a.options.tolerance = 0.5; });
  row("slices of blend: plain steps", "integration", "on 0.25 voxel plain smooth",
      [](Asked& a) { a.options.method = Method::blend; });
  row("planes by OpenGL, a step in the curve: finer plain steps", "integration",
      "on 0.125 voxel plain curve step", [](Asked& a) {
        a.options.resampler = Resampler::gl;
        a.scene.transferFunction.points[1].value = 151;
      });
  row("mip", "integration", "on cell extremes exact", [](Asked& a) { a.scene.mode = Mode::mip; });
  row("a mean, nothing left out", "integration", "on cell means exact", [](Asked& a) {
    a.scene.mode = Mode::average;
    a.options.full = true;
  });
  row("mip by blend: finer plain steps", "integration", "on 0.125 voxel plain extremes means", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.options.method = Method::blend;
  });
  row("a mean by OpenGL: finer plain steps", "integration", "on 0.125 voxel plain extremes means",
      [](Asked& a) {
        a.scene.mode = Mode::average;
        a.options.resampler = Resampler::gl;
      });
  row("mip in steps as asked", "integration", "on 2 voxels plain asked", [](Asked& a) {
    a.scene.mode = Mode::mip;
    a.options.step = 2;
  });
  row("a step as asked", "integration", "on 2 voxels plain asked", [](Asked& a) { a.options.step = 2; });
  row("little changes from voxel to voxel", "integration", "on 0.3477 voxel 0.011 0.005 plain slope",
      evenMatter);
  row("along a diagonal no cells are met alike", "integration", "on 0.375 voxel 0.011 0.005 plain slope",
      [](Asked& a) {
        evenMatter(a);
        a.scene.camera = Camera{};
        a.scene.camera->direction = {1, 1, 1};
      });
  row("unlit: high too, finer", "integration", "on 0.2426 voxel 0.01 0.0045 plain slope", [](Asked& a) {
    evenMatter(a);
    a.options.quality = Quality::high;
    a.scene.shading.lit = false;
  });
  row("lit: high goes cell by cell", "integration", high, [](Asked& a) {
    evenMatter(a);
    a.options.quality = Quality::high;
  });
  row("ten times as much changes", "integration", "on 0.3477 voxel 0.011 0.05 plain slope", [](Asked& a) {
    evenMatter(a);
    a.facts.gradientBounds.assign(256, 9000);
  });
  row("the error of each pixel is asked for", "integration", atStandard.c_str(), [](Asked& a) {
    evenMatter(a);
    a.options.withError = true;
  });
  row("a comb of peaks may repeat along rays", "integration", atStandard.c_str(), [](Asked& a) {
    evenMatter(a);
    auto& points = a.scene.transferFunction.points;
    points.clear();
    for (int n = 0; n < 11; ++n) points.push_back({float(100 * n), {}, 0.001 * (n % 2)});
  });
  row("four hundred times as much changes", "integration", "on 0.1847 voxel 0.011 2 plain slope",
      [](Asked& a) {
        evenMatter(a);
        a.facts.gradientBounds.assign(256, 360000);
      });
  row("too much changes", "integration", standard, [](Asked& a) {
    evenMatter(a);
    a.facts.gradientBounds.assign(256, 900000);
  });
  row("light turns over within a voxel", "integration", standard, [](Asked& a) {
    evenMatter(a);
    a.scene.transferFunction.points = {{-1000, {}, 0.3}};
  });
  row("unlit it does not", "integration", "on 0.3477 voxel 0.3 0 plain slope", [](Asked& a) {
    evenMatter(a);
    a.scene.transferFunction.points = {{-1000, {}, 0.3}};
    a.scene.shading.lit = false;
  });
  row("longer voxels add more", "integration", "on 0.1847 voxel 0.16 0.08 plain slope", [](Asked& a) {
    evenMatter(a);
    a.facts.geometry.patientFromVoxelStep[1][1] = 16;
  });
  row("voxels that are long across the view do not", "integration", "on 0.3477 voxel 0.011 0.005 plain slope",
      [](Asked& a) {
        evenMatter(a);
        a.facts.geometry.patientFromVoxelStep[2][2] = 16;
      });
  row("but in perspective, where rays go along them too", "integration",
      "on 0.1847 voxel 0.16 0.08 plain slope", [](Asked& a) {
        evenMatter(a);
        a.facts.geometry.patientFromVoxelStep[2][2] = 16;
        a.scene.camera = Camera{};
        a.scene.camera->projection = Projection::perspective;
      });
  row("what gradients make of the opacity is unknown", "integration", standard, [](Asked& a) {
    evenMatter(a);
    a.scene.transferFunction.gradientOpacity = {{0, 0}, {100, 1}};
  });
  row("a table of the curve jumps", "integration", standard, [](Asked& a) {
    evenMatter(a);
    a.options.curveTable = 256;
  });
  row("nothing is known of the values", "integration", standard, [](Asked& a) {
    evenMatter(a);
    a.facts.gradientBounds.clear();
  });
}

void TestIntegrationRule::theRuleSaysWhatAndWhy() { compareEffect(); }

void TestIntegrationRule::stepsAreLeftOpenWhereTheyMayPay_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* name, const char* expected, Change change) {
    QTest::newRow(name) << change << QString::fromLatin1(expected);
  };
  row("standard", "0.062 0.72", [](Asked&) {});
  row("high", "0.049 0.31", [](Asked& a) {
    a.options.quality = Quality::high;
    a.scene.transferFunction.points[1].opacity = 0.07;
  });
  row("high, where few rays may matter: rays are redone", "0.049 0.22 10/255",
      [](Asked& a) { a.options.quality = Quality::high; });
  row("where the volume is known to be even, longer ones", "0.43 0.72", [](Asked& a) { evenMatter(a); });
  row("nothing left out: the same choice", "0.062 0.72", [](Asked& a) { a.options.full = true; });
  row("draft: one of two lengths", "0.081 0.72", [](Asked& a) { a.options.quality = Quality::draft; });
  row("a draft whose error is asked for", "", [](Asked& a) {
    a.options.quality = Quality::draft;
    a.options.withError = true;
  });
  row("a small draft, too", "0.081 0.72", [](Asked& a) {
    a.options.quality = Quality::draft;
    a.options.size = {100, 90};
  });
  row("exact promises a maximum", "", [](Asked& a) { a.options.quality = Quality::exact; });
  row("a small picture has too few rays", "", [](Asked& a) { a.options.size = {383, 384}; });
  row("the smallest that has enough", "0.062 0.72", [](Asked& a) { a.options.size = {384, 384}; });
  row("a strip", "", [](Asked& a) { a.options.size = {16384, 127}; });
  row("a step as asked", "", [](Asked& a) { a.options.step = 1; });
  row("a tolerance as asked", "", [](Asked& a) { a.options.tolerance = 0.1; });
  row("a table of the curve", "", [](Asked& a) { a.options.curveTable = 256; });
  row("faint samples left out", "", [](Asked& a) { a.options.opacityThreshold = 0.1; });
  row("blend", "", [](Asked& a) { a.options.method = Method::blend; });
  row("by OpenGL", "", [](Asked& a) { a.options.resampler = Resampler::gl; });
  row("a maximum", "", [](Asked& a) { a.scene.mode = Mode::mip; });
  row("a mean", "", [](Asked& a) { a.scene.mode = Mode::average; });
  row("a step in the curve", "", [](Asked& a) { a.scene.transferFunction.points[1].value = 151; });
  row("what few rays meet may hide what lies behind it: rays are redone", "0.062 0.42 32/255",
      [](Asked& a) { a.scene.transferFunction.points[1].opacity = 0.25; });
  row("it may not", "0.062 0.72", [](Asked& a) { a.scene.transferFunction.points[1].opacity = 0.2; });
  row("where voxels are opaque", "0.062 0.42 32/255",
      [](Asked& a) { a.scene.transferFunction.points[1].opacity = 0.9; });
  row("long voxels hide more", "0.062 0.42 32/255",
      [](Asked& a) { a.facts.geometry.patientFromVoxelStep[1][1] = 3; });
  row("nothing is known of the values", "", [](Asked& a) { a.facts.gradientBounds.clear(); });
  row("where little is visible they take longer than going cell by cell", "", [](Asked& a) {
    constexpr int blocks = 4096;
    std::vector<float> high(blocks, -900);
    high.back() = 1000;
    a.facts.geometry.size.x = blocks * 4;
    a.facts.blockRanges = std::make_shared<const BlockRanges>(
        blockRangesOf(4, {blocks, 1, 1}, std::vector<float>(blocks, -1000), high));
  });
}

void TestIntegrationRule::stepsAreLeftOpenWhereTheyMayPay() {
  QFETCH(Change, change);
  QFETCH(QString, expected);
  Asked asked;
  asked.scene.transferFunction.points = {{150, {}, 0}, {400, {}, 0.1}};
  asked.facts.gradientBounds.assign(256, 900000);
  change(asked);
  const Plan plan = *makePlan(asked.scene, asked.facts, asked.options);
  const auto& steps = plan.pilotSteps;
  const auto words = [](double x) { return QString::number(x, 'g', 2); };
  QStringList found;
  if (steps) found = {words(steps->shortest), words(steps->first)};
  if (steps && steps->redoneAbove > 0) found << words(255 * steps->redoneAbove) + QStringLiteral("/255");
  QCOMPARE(found.join(QLatin1Char(' ')), expected);
  QVERIFY(!plan.pilot);
}

void TestIntegrationRule::whatAPilotFoundIsSaid_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<PilotFinding>("found");
  QTest::addColumn<QString>("states");
  const auto row = [](const char* name, PilotFinding found, const char* states, Change change) {
    QTest::newRow(name) << change << found << QString::fromLatin1(states);
  };
  row("good enough", {0.5, true, 2354, 45.34, 5.52},
      "on 0.5 voxel 2354 45.3 dB 99 5.52/255 plain PSNR least percentile most", [](Asked&) {});
  row("good enough, with rays redone", {0.5, true, 2354, 45.34, 5.52, 32.0 / 255},
      "on 0.5 voxel 32/255 2354 45.3 dB 99 5.52/255 plain every other step cell by cell", [](Asked&) {});
  row("not good enough", {0.5, false, 1839, 41.7, 10.04},
      cellByCell(Quality::standard, "0.5 voxel 1839 41.7 dB 99 10/255",
                 "not plain PSNR least percentile most")
          .c_str(),
      [](Asked&) {});
  row("nothing to be seen", {0.5, false, 0, 0, 0},
      cellByCell(Quality::standard, "0.5 voxel", "not plain no ray").c_str(), [](Asked&) {});
  PilotFinding ofDraft{0.7236, true, 840};
  ofDraft.blockRmse = 1.5;
  ofDraft.meanColour = 0.414;
  row("good enough for a draft", ofDraft, "on 0.7236 voxel 840 1.5/255 0.42/255 plain blocks mean colour",
      [](Asked& a) { a.options.quality = Quality::draft; });
  row("not good enough where the volume is even", {0.5, false, 1839, 41.7, 10.04},
      "on 0.3477 voxel 0.011 0.005 0.5 voxel 1839 41.7 dB 99 10/255 plain slope not plain PSNR least "
      "percentile most",
      evenMatter);
}

void TestIntegrationRule::whatAPilotFoundIsSaid() {
  QFETCH(Change, change);
  QFETCH(PilotFinding, found);
  QFETCH(QString, states);
  Asked asked;
  change(asked);
  const Plan plan = *makePlan(asked.scene, asked.facts, asked.options, found);
  QVERIFY(plan.pilot == found);
  QVERIFY(!plan.pilotSteps);
  const QString wrong = doesNotState(plan, QStringLiteral("integration"), states);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

VOLUMEN_TEST(TestIntegrationRule);
#include "tst_integration_rule.moc"
