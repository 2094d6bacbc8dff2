// Guards segment.md, "Use a built-in recipe": findings and refusals of the built-in recipes in real patients.
// Each bound has a stated reason. Lesions of a PET are compared with numbers that numpy found in its files.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/fixtures/real_volume.h"
#include "tests/unit/suite.h"
#include "viewer/measure/peak.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/numbers.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

class TestRealRecipes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void findsSoMuch_data();
  void findsSoMuch();
  void isRefused_data();
  void isRefused();
  void bothLungsAreInsideTheBody();
  void airwaysAreInsideTheBody();
  void boneIsInsideTheBody_data();
  void boneIsInsideTheBody();
  void theBrainIsNoBone();
  void printsHaveNoCrumbs_data();
  void printsHaveNoCrumbs();
  void theSpinalCanalIsNoBone();
  void lesionsAreThoseOfNumpy_data();
  void lesionsAreThoseOfNumpy();
};

namespace {

constexpr const char chestCt[] = "ct-chest-lidc0314-138",
                     headCt[] = "dicom-geometry/ct-ge-tilt-varspacing-28", handCt[] = "pet-ct/sts019-ct",
                     bareCt[] = "dicom-geometry/ct-head-slicer-93", headMr[] = "mr-head-siemens-gap-175",
                     gridMr[] = "mr-head-ge-mprage-130", handPet[] = "pet-ct/sts019-pet";

// Loads each series once. Returns null if the data are absent.
VolumePtr seriesAt(const std::string& path) {
  static std::map<std::string, VolumePtr> all;
  const auto [found, isNew] = all.try_emplace(path);
  if (isNew) found->second = realVolume(path);
  return found->second;
}

const Recipe& builtIn(const std::string& name) {
  return *std::ranges::find(builtInRecipes(), name, &Recipe::name);
}

// Runs each recipe once per series.
const Result<Segmented>& followed(const std::string& path, const std::string& recipe) {
  static std::map<std::pair<std::string, std::string>, Result<Segmented>> all;
  const std::pair key(path, recipe);
  if (!all.contains(key)) all.emplace(key, follow(builtIn(recipe), *seriesAt(path)));
  return all.at(key);
}

BitMask segmentOf(const std::string& path, const std::string& recipe, const std::string& name) {
  const Result<Segmented>& made = followed(path, recipe);
  if (!made) throw std::runtime_error(made.message());
  const auto segment = std::ranges::find(made->segments, name, &Segment::label);
  return maskOf(made->labels, std::uint8_t(segment->number));
}

double mlOf(const BitMask& mask) { return double(mask.count()) * mask.geometry().voxelVolume() / 1000; }

// Returns the share of a mask inside another mask.
double shareIn(const BitMask& mask, const BitMask& other) {
  return double(intersected(mask, other).count()) / double(mask.count());
}

QByteArray number(double value) { return QByteArray::number(value); }

}  // namespace

void TestRealRecipes::findsSoMuch_data() {
  QTest::addColumn<QString>("series");
  QTest::addColumn<QString>("recipe");
  QTest::addColumn<QString>("segment");
  QTest::addColumn<double>("least");
  QTest::addColumn<double>("most");
  const auto row = [](const char* name, const char* series, const char* recipe, const char* segment,
                      double least, double most) {
    QTest::newRow(name) << QString::fromLatin1(series) << QString::fromLatin1(recipe)
                        << QString::fromLatin1(segment) << least << most;
  };
  // The trunk is 276 mm long, from shoulders to liver.
  row("a trunk", chestCt, "Body", "Body", 12000, 25000);
  // The surface is 3,700 cm^2, cut ends included, and 2 mm deep.
  row("its skin", chestCt, "Skin", "Skin", 300, 800);
  // Bones are ribs, shoulders and 14 vertebrae.
  row("its bones", chestCt, "Bone", "Bone", 600, 3000);
  // From a collapsed lobe in a small woman to the largest total lung capacity.
  row("its lungs", chestCt, "Lungs and airways", "Lungs", 1500, 8000);
  // Trachea and main bronchi have 30 to 40 ml. A leak into a lung adds hundreds.
  row("its airways", chestCt, "Airways", "Airways", 15, 80);
  // The series starts at the base of the skull.
  row("a head", headCt, "Body", "Body", 2500, 5000);
  // The skull lacks its lower jaw. With the brain it would be above 2000.
  row("its skull", headCt, "Bone", "Bone", 400, 1000);
  row("its skin", headCt, "Skin", "Skin", 80, 400);
  row("a hand and a forearm", handCt, "Body", "Body", 500, 1000);
  row("their bones", handCt, "Bone", "Bone", 60, 200);
  // The series covers crown to chin. A head has about 3 to 5 l.
  row("a head by MR", headMr, "Head surface (MR)", "Head", 3000, 5000);
  // Lines of less than 4 mm leave no voxel, which is reported.
  row("a grid that is no head", gridMr, "Head surface (MR)", "Head", 0, 0);
}

void TestRealRecipes::findsSoMuch() {
  QFETCH(QString, series);
  QFETCH(QString, recipe);
  QFETCH(QString, segment);
  QFETCH(double, least);
  QFETCH(double, most);
  NEED_VOLUME(seriesAt(series.toStdString()));
  const double ml = mlOf(segmentOf(series.toStdString(), recipe.toStdString(), segment.toStdString()));
  QVERIFY2(ml >= least && ml <= most, number(ml));
}

void TestRealRecipes::isRefused_data() {
  QTest::addColumn<QString>("series");
  QTest::addColumn<QString>("recipe");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* series, const char* recipe, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(series) << QString::fromLatin1(recipe)
                        << QString::fromLatin1(says);
  };
  for (const char* recipe : {"Airways", "Lungs and airways"}) {
    const char* const none = "no trachea was found";
    row(qPrintable(QStringLiteral("%1 of a head").arg(QLatin1String(recipe))), headCt, recipe, none);
    row(qPrintable(QStringLiteral("%1 of a hand").arg(QLatin1String(recipe))), handCt, recipe, none);
  }
  for (const char* recipe :
       {"Body", "Skin", "Bone", "Airways", "Lungs and airways", "Vessels with contrast"}) {
    row(qPrintable(QStringLiteral("%1 of an MR").arg(QLatin1String(recipe))), headMr, recipe,
        "the series is MR, not CT");
    row(qPrintable(QStringLiteral("%1 of a PET").arg(QLatin1String(recipe))), handPet, recipe,
        "the series is PT, not CT");
    row(qPrintable(QStringLiteral("%1 of values without their rescale").arg(QLatin1String(recipe))), bareCt,
        recipe, "the series lacks the rescale");
  }
}

void TestRealRecipes::isRefused() {
  QFETCH(QString, series);
  QFETCH(QString, recipe);
  QFETCH(QString, says);
  NEED_VOLUME(seriesAt(series.toStdString()));
  const Result<Segmented>& made = followed(series.toStdString(), recipe.toStdString());
  QVERIFY(!made);
  QVERIFY2(QString::fromStdString(made.message()).contains(says), made.message().c_str());
}

// The air along the skin is no lung. It must not replace the smaller lung.
void TestRealRecipes::bothLungsAreInsideTheBody() {
  const VolumePtr volume = seriesAt(chestCt);
  NEED_VOLUME(volume);
  const BitMask lungs = segmentOf(chestCt, "Lungs and airways", "Lungs"),
                body = segmentOf(chestCt, "Body", "Body"),
                airways = segmentOf(chestCt, "Lungs and airways", "Airways");
  QVERIFY2(shareIn(lungs, body) > 0.999, number(shareIn(lungs, body)));
  QVERIFY(intersected(lungs, airways).empty());
  const double mean = valuesIn(lungs, *volume).mean;
  QVERIFY2(mean > -900 && mean < -600, number(mean));  // air and tissue
  const double middle = formOf(body)->value().centroid.x;
  std::int64_t right = 0;
  const std::vector<glm::ivec3> voxels = voxelsOf(lungs);
  for (const glm::ivec3& v : voxels) right += volume->geometry().patientFromVoxel(glm::dvec3(v)).x < middle;
  const double share = double(right) / double(voxels.size());
  QVERIFY2(share > 0.25 && share < 0.75, number(share));
}

void TestRealRecipes::airwaysAreInsideTheBody() {
  const VolumePtr volume = seriesAt(chestCt);
  NEED_VOLUME(volume);
  const BitMask airways = segmentOf(chestCt, "Airways", "Airways"), body = segmentOf(chestCt, "Body", "Body");
  QVERIFY2(shareIn(airways, body) > 0.999, number(shareIn(airways, body)));
  const SegmentForm tree = formOf(airways)->value();
  QVERIFY2(valuesIn(airways, *volume).mean < -900, number(valuesIn(airways, *volume).mean));
  // From the neck past the carina: longer than a trachea, which has at most 12 cm.
  QVERIFY2(tree.longestMm > 120 && tree.longestMm < 300, number(tree.longestMm));
}

void TestRealRecipes::boneIsInsideTheBody_data() {
  QTest::addColumn<QString>("series");
  QTest::newRow("a chest on its table") << QString::fromLatin1(chestCt);
  QTest::newRow("a head in its headrest") << QString::fromLatin1(headCt);
  QTest::newRow("a hand") << QString::fromLatin1(handCt);
}

void TestRealRecipes::boneIsInsideTheBody() {
  QFETCH(QString, series);
  NEED_VOLUME(seriesAt(series.toStdString()));
  const double share = shareIn(segmentOf(series.toStdString(), "Bone", "Bone"),
                               segmentOf(series.toStdString(), "Body", "Body"));
  QVERIFY2(share > 0.999, number(share));
}

// A ball of 4 cm in the middle of the head.
void TestRealRecipes::theBrainIsNoBone() {
  const VolumePtr volume = seriesAt(headCt);
  NEED_VOLUME(volume);
  const glm::dvec3 middle = formOf(segmentOf(headCt, "Body", "Body"))->value().centroid;
  NamedMasks masks;
  QVERIFY(runStep({"ball", "Ball", {{"at", std::vector<glm::dvec3>{middle}}, {"radiusMm", 40.0}}}, *volume,
                  masks));
  const double share = shareIn(masks.at("Ball"), segmentOf(headCt, "Bone", "Bone"));
  QVERIFY2(share < 0.02, number(share));
}

void TestRealRecipes::printsHaveNoCrumbs_data() {
  QTest::addColumn<QString>("series");
  QTest::addColumn<QString>("recipe");
  for (const auto& [name, series] : {std::pair("a chest", chestCt), {"a head", headCt}, {"a hand", handCt}})
    for (const char* recipe : {"Bone", "Skin", "Vessels with contrast"})
      QTest::addRow("%s of %s", recipe, name) << QString::fromLatin1(series) << QString::fromLatin1(recipe);
}

// Surfaces join voxels by faces. No part of a print may be below 1 ml, the limit of the recipes, and bones
// may have no cavities.
void TestRealRecipes::printsHaveNoCrumbs() {
  QFETCH(QString, series);
  QFETCH(QString, recipe);
  NEED_VOLUME(seriesAt(series.toStdString()));
  const std::string name = recipe.section(QLatin1Char(' '), 0, 0).toStdString();
  const BitMask mask = segmentOf(series.toStdString(), recipe.toStdString(), name);
  const Parts parts(mask, Neighbours::faces);
  const double least = double(parts.size(parts.count() - 1)) * mask.geometry().voxelVolume() / 1000;
  QVERIFY2(least >= 1, number(least));
  if (name == "Bone") QVERIFY(holesFilled(mask) == mask);
}

// Covers 3 mm about a line along the canal in the lower chest. Bone encloses the canal only in transverse
// slices.
void TestRealRecipes::theSpinalCanalIsNoBone() {
  const VolumePtr volume = seriesAt(chestCt);
  NEED_VOLUME(volume);
  NamedMasks masks;
  const std::vector<glm::dvec3> canal{{-8, 249, -594}, {-8, 237, -641}};
  QVERIFY(runStep({"paint", "Canal", {{"at", canal}, {"radiusMm", 3.0}}}, *volume, masks));
  const double share = shareIn(masks.at("Canal"), segmentOf(chestCt, "Bone", "Bone"));
  QVERIFY2(share < 0.02, number(share));
}

void TestRealRecipes::lesionsAreThoseOfNumpy_data() {
  QTest::addColumn<QString>("by");
  QTest::addColumn<double>("from");
  QTest::addColumn<int>("voxels");
  QTest::addColumn<double>("mean");
  QTest::addColumn<double>("glycolysis");
  // SUVmax and SUVpeak are those of the same voxel and ball in all rows.
  QTest::newRow("41 % of the maximum") << "share" << 0.41 << 307 << 9.70702 << 214.1186;
  QTest::newRow("50 % of the maximum") << "share" << 0.5 << 206 << 10.81655 << 160.0981;
  QTest::newRow("from SUV 2.5 on") << "value" << 2.5 << 654 << 6.75118 << 317.2397;
  QTest::newRow("from SUV 4 on") << "value" << 4.0 << 464 << 8.24616 << 274.9161;
}

// Searches 6 cm about the largest value. In numpy: a flood fill by faces, and peaks from 12^3 samples a
// voxel.
void TestRealRecipes::lesionsAreThoseOfNumpy() {
  QFETCH(QString, by);
  QFETCH(double, from);
  QFETCH(int, voxels);
  QFETCH(double, mean);
  QFETCH(double, glycolysis);
  const VolumePtr volume = seriesAt(handPet);
  NEED_VOLUME(volume);
  NamedMasks masks;
  const std::vector<glm::dvec3> at{{-7.03125, -82.03125, -140.65}};
  QVERIFY(runStep({"ball", "Ball", {{"at", at}, {"radiusMm", 60.0}}}, *volume, masks));
  QVERIFY(runStep({"lesion",
                   "Lesion",
                   {{"in", std::string("Ball")},
                    {"by", by.toStdString()},
                    {by == QStringLiteral("share") ? "share" : "value", from}}},
                  *volume, masks));
  const SegmentValues values = valuesIn(masks.at("Lesion"), *volume);
  QCOMPARE(values.voxels, std::int64_t(voxels));
  QVERIFY2(std::abs(values.max - 16.327686) < 1e-5, number(values.max));
  QVERIFY2(std::abs(values.mean - mean) < 1e-4, number(values.mean));
  const auto peak = peakAbout(voxelsOf(masks.at("Lesion")), *volume);
  QVERIFY2(peak && std::abs(peak->mean - 11.7579) < 1e-3 * 11.7579, number(peak->mean));
  const double found = values.mean * mlOf(masks.at("Lesion"));
  QVERIFY2(std::abs(found - glycolysis) < 1e-3 * glycolysis, number(found));
}

VOLUMEN_TEST(TestRealRecipes);
#include "tst_real_recipes.moc"
