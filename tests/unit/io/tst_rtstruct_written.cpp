// Guards export/rtstruct.h: segments leave as contours of the acquired slices, valid for other programs, and
// come back voxel by voxel.
#include <QFile>
#include <cmath>
#include <set>

#include "io/contours.h"
#include "io/export/read_segments.h"
#include "io/export/rtstruct.h"
#include "io/load.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/segmentation_slices.h"
#include "tests/unit/io/study_sources.h"
#include "tests/unit/suite.h"
#include "viewer/slice/plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Balls with holes, plates one voxel thick, crumbs: a label each, later ones over earlier ones.
Segmented randomShapes(const VoxelGeometry& grid, Chance& chance) {
  LabelEdit edit{LabelMap(grid)};
  Segmented all{{}, LabelMap(grid)};
  const int count = 1 + chance.below(4);
  for (int label = 1; label <= count; ++label) {
    const glm::dvec3 centre = glm::dvec3(grid.size) * (chance.vector() * 0.5 + 0.5);
    const double radius = chance.between(0.5, 7), hole = chance.oneIn(2) ? radius * chance.share() : 0;
    const int kind = chance.below(3);
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) {
          const double r = glm::length(glm::dvec3(i, j, k) - centre);
          const bool inside = kind == 0   ? r < radius && r >= hole
                              : kind == 1 ? i == int(centre.x) || j == int(centre.y)
                                          : chance.oneIn(9);
          if (inside) edit.set({i, j, k}, std::uint8_t(label));
        }
    all.segments.push_back(randomSegment(label, chance));
    all.segments.back().label += " " + std::to_string(label);
  }
  all.labels = edit.done();
  return all;
}

std::string rtOf(const Slices& slices) { return slices.folder.path("rt.dcm"); }

// Returns the segment whose name begins with this one.
const Segment* segmentOf(const Segmented& map, const std::string& name) {
  const auto found = std::ranges::find(map.segments, name, &Segment::label);
  return found == map.segments.end() ? nullptr : &*found;
}

}  // namespace

class TestRtstructWritten : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void realSourcesGiveValidObjects_data();
  void realSourcesGiveValidObjects();
  void randomShapesComeBack();
  void contoursLieAsTheStandardWants();
  void unevenSlicesComeBack();
  void longContoursAreWrittenWhole();
  void segmentsWithoutPixelsAreLeftOut();
  void namesStayAsTheyAre_data() { addNames(); }
  void namesStayAsTheyAre();
  void whatCannotBeWrittenIsRefused();
  void aFullDiskKeepsNothing();
};

void TestRtstructWritten::realSourcesGiveValidObjects_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<bool>("oblique");
  QTest::newRow("CT") << QStringLiteral("ct-chest-lidc0314-138") << false;
  QTest::newRow("MR oblique") << QStringLiteral("mr-head-ge-mprage-130") << true;
  QTest::newRow("CT tilted") << QStringLiteral("dicom-geometry/ct-ge-tilt-varspacing-28") << true;
  QTest::newRow("PET") << QStringLiteral("pet-ct/sts019-pet") << false;
  QTest::newRow("MR enhanced") << QStringLiteral("dicom-geometry/mr-enh-siemens-xa10") << false;
}

// Two segments by thresholds, over all slices.
void TestRtstructWritten::realSourcesGiveValidObjects() {
  QFETCH(QString, source);
  QFETCH(bool, oblique);
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath(source.toStdString()));
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  const Volume& volume = *loaded->drawn;
  const VoxelGeometry& grid = volume.geometry();
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  float low = volume.valueAt(0), high = low;
  for (std::size_t n = 0; n < dense.labels.size(); ++n)
    low = std::min(low, volume.valueAt(n)), high = std::max(high, volume.valueAt(n));
  // Only around the middle: dciodvfy needs minutes for a million points.
  const glm::ivec3 middle = grid.size / 2;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = std::max(0, middle.y - 12); j < std::min(grid.size.y, middle.y + 12); ++j)
      for (int i = std::max(0, middle.x - 12); i < std::min(grid.size.x, middle.x + 12); ++i) {
        const std::size_t n =
            (std::size_t(k) * std::size_t(grid.size.y) + std::size_t(j)) * std::size_t(grid.size.x) +
            std::size_t(i);
        dense.labels[n] = std::uint8_t(1.99F * (volume.valueAt(n) - low) / (high - low)) + 1;
      }
  const Segmented in{{{.number = 1, .label = "Middle"}, {.number = 2, .label = "Bright"}}, LabelMap(dense)};
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("rt.dcm")).toStdString();
  const auto notes = writeStructureSet({&in, 1}, series, {}, path);
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QCOMPARE(isSaid(*notes, "one z for each contour"), oblique);
  COMPARE_WITH_STANDARD(path, series.files[0]);
  QCOMPARE(notAsInSource(path, series.files[0]).join(QLatin1Char(10)), QString());
  const auto read = readSegments(path, series, grid, {}, {}, acquiredSlicesOf(*loaded));
  QVERIFY2(read, read ? "" : read.message().c_str());
  QCOMPARE(read->maps.size(), std::size_t(1));
  if (!series.regular) QVERIFY(read->maps[0].labels == in.labels);
}

// Thousands with VOLUMEN_THOROUGH: on slices of any direction, the same voxels come back, with names and
// colours.
void TestRtstructWritten::randomShapesComeBack() {
  const Seeds seeds = seedsOf(60, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const QByteArray which = QByteArray::number(seed);
    const Slices slices({3 + chance.below(20), 3 + chance.below(20)},
                        even(2 + chance.below(8), chance.between(0.5, 4)), chance);
    QVERIFY2(slices.isThere(), which.constData());
    const Segmented in = randomShapes(slices.grid, chance);
    const auto notes = writeStructureSet({&in, 1}, slices.series, {}, rtOf(slices));
    const auto counts = labelCounts(in.labels);
    const bool isEmpty = counts[0] == slices.grid.voxelCount();
    QVERIFY2(notes.ok() != isEmpty, which.constData());
    if (isEmpty) continue;
    const auto out = readSegments(rtOf(slices), slices.series, slices.grid);
    QVERIFY2(out, out ? "" : (which + ": " + out.message().c_str()).constData());
    QVERIFY2(out->maps.size() == 1, which.constData());
    for (const Segment& segment : in.segments) {
      const Segment* read = segmentOf(out->maps[0], segment.label);
      QVERIFY2((read != nullptr) == (counts[std::size_t(segment.number)] > 0), which.constData());
      if (!read) continue;
      QVERIFY2(read->colour == segment.colour && read->type == segment.type, which.constData());
      QVERIFY2(maskOf(out->maps[0].labels, std::uint8_t(read->number)) ==
                   maskOf(in.labels, std::uint8_t(segment.number)),
               which.constData());
    }
    // The contours by themselves enclose the volume: holes count against it.
    const auto set = loadContours(rtOf(slices));
    QVERIFY2(set, which.constData());
    for (const RegionOfInterest& region : set->regions) {
      double mm3 = 0;
      for (const Contour& contour : region.contours) mm3 += areaOf(contour) * sliceDistance(slices.grid);
      const Segment& segment = *segmentOf(in, region.name);
      const double expected = double(counts[std::size_t(segment.number)]) * slices.grid.voxelVolume();
      QVERIFY2(std::abs(mm3 - expected) <= 0.01 * expected, which.constData());
    }
    QVERIFY(QFile::remove(QString::fromStdString(rtOf(slices))));
  }
}

void TestRtstructWritten::contoursLieAsTheStandardWants() {
  Chance chance(5);
  const Slices slices({15, 12}, even(5, 2.5), chance);
  Segmented in{{{.number = 7, .label = "Liver", .category = {"123037004", "SCT", "Anatomical Structure"}},
                {.number = 9, .label = "Rest", .algorithmType = SegmentAlgorithm::automatic}},
               LabelMap(slices.grid)};
  LabelEdit edit(in.labels);
  for (int j = 2; j < 9; ++j)
    for (int i = 3; i < 12; ++i)
      if (i != 6 || j != 5) edit.set({i, j, 2}, 7);
  edit.set({0, 0, 0}, 9);
  in.labels = edit.done();
  QVERIFY(writeStructureSet({&in, 1}, slices.series, {}, rtOf(slices)).ok());
  ReadObject object(rtOf(slices));
  QCOMPARE(object[DCM_SOPClassUID], std::string("1.2.840.10008.5.1.4.1.1.481.3"));
  QCOMPARE(object[DCM_Modality], std::string("RTSTRUCT"));
  QVERIFY(object[DCM_StructureSetLabel].size() <= 16 && !object[DCM_StructureSetLabel].empty());
  DcmItem* series =
      itemOf(itemOf(object.item(DCM_ReferencedFrameOfReferenceSequence), DCM_RTReferencedStudySequence),
             DCM_RTReferencedSeriesSequence);
  QVERIFY(series);
  QCOMPARE(attributeText(*object.item(DCM_ReferencedFrameOfReferenceSequence), DCM_FrameOfReferenceUID),
           std::string("1.2.3.7"));
  QCOMPARE(attributeText(*series, DCM_SeriesInstanceUID), slices.series.seriesUid);
  std::set<std::string> pictures;
  for (long n = 0; DcmItem* picture = itemOf(series, DCM_ContourImageSequence, n); ++n)
    pictures.insert(attributeText(*picture, DCM_ReferencedSOPInstanceUID));
  const auto& uids = slices.series.sopInstanceUids;
  QVERIFY(pictures == std::set<std::string>(uids.begin(), uids.end()));
  for (long n = 0; n < 2; ++n) {
    const std::string number = std::to_string(n + 1);
    QCOMPARE(attributeText(*object.item(DCM_StructureSetROISequence, n), DCM_ROINumber), number);
    QCOMPARE(attributeText(*object.item(DCM_ROIContourSequence, n), DCM_ReferencedROINumber), number);
    QCOMPARE(attributeText(*object.item(DCM_RTROIObservationsSequence, n), DCM_ReferencedROINumber), number);
    QVERIFY(object.item(DCM_RTROIObservationsSequence, n)->tagExists(DCM_ROIInterpreter));
  }
  QCOMPARE(attributeText(*object.item(DCM_RTROIObservationsSequence), DCM_RTROIInterpretedType),
           std::string("ORGAN"));
  QCOMPARE(attributeText(*object.item(DCM_StructureSetROISequence, 1), DCM_ROIGenerationAlgorithm),
           std::string("AUTOMATIC"));
  // One contour with a keyhole, in the plane of the slice that it names.
  DcmItem* liver = object.item(DCM_ROIContourSequence);
  DcmItem* contour = itemOf(liver, DCM_ContourSequence);
  QVERIFY(contour && !itemOf(liver, DCM_ContourSequence, 1));
  QCOMPARE(attributeText(*itemOf(contour, DCM_ContourImageSequence), DCM_ReferencedSOPInstanceUID), uids[2]);
  for (const QString& number :
       QString::fromStdString(attributeText(*contour, DCM_ContourData)).split(QLatin1Char('\\')))
    QVERIFY2(number.trimmed().size() <= 16, qPrintable(number));
  const auto set = loadContours(rtOf(slices));
  QVERIFY(set.ok());
  const std::vector<glm::dvec3>& points = set->regions[0].contours[0].points;
  QCOMPARE(points.size(), std::size_t(4 + 4 + 2));
  for (const glm::dvec3 p : points) QVERIFY(std::abs(slices.grid.voxelFromPatient(p).z - 2) * 2.5 < 0.01);
  QVERIFY(points.front() != points.back());
}

void TestRtstructWritten::unevenSlicesComeBack() {
  Chance chance(11);
  for (const bool isMissing : {true, false}) {
    // The slice at 6 is missing, or one lies between two of the grid.
    const Slices slices(
        {12, 11},
        isMissing ? std::vector<double>{0, 2, 4, 8, 10, 12} : std::vector<double>{0, 2, 4.8, 6, 8, 10},
        chance);
    QVERIFY(slices.series.regular.has_value());
    const auto loaded = loadSeries(slices.series);
    QVERIFY(loaded.ok());
    const Segmented in{{{.number = 1, .label = "All"}},
                       withLabel(LabelMap(slices.grid), 1, inverted(BitMask(slices.grid)))};
    const auto notes = writeStructureSet({&in, 1}, slices.series, {}, rtOf(slices));
    QVERIFY2(notes, notes ? "" : notes.message().c_str());
    const auto out =
        readSegments(rtOf(slices), slices.series, slices.grid, {}, {}, acquiredSlicesOf(*loaded));
    QVERIFY2(out, out ? "" : out.message().c_str());
    const Segmented& map = out->maps[0];
    if (isMissing) {
      for (int k = 0; k < slices.grid.size.z; ++k)
        QCOMPARE(map.labels.at({3, 3, k}), std::uint8_t(k == 3 ? 0 : 1));
      QVERIFY2(isSaid(*notes, "; its contours on the acquired slices enclose "), "the slice is told in ml");
    } else {
      QVERIFY(map.acquired != nullptr);
      QCOMPARE(labelCounts(map.acquired->labels)[1], std::int64_t(6 * 12 * 11));
    }
  }
}

// Values of more than 64 kB do not fit Explicit VR.
void TestRtstructWritten::longContoursAreWrittenWhole() {
  Chance chance(2);
  const Slices slices({200, 200}, even(2, 1), chance);
  Segmented in{{{.number = 1, .label = "Comb"}}, LabelMap(slices.grid)};
  LabelEdit edit(in.labels);
  for (int j = 0; j < 200; ++j)
    for (int i = 0; i < 200; ++i)
      if (i % 2 == 0 || j == 100 || (j % 2 == 0 && i % 3 == 0)) edit.set({i, j, 1}, 1);
  in.labels = edit.done();
  QVERIFY(writeStructureSet({&in, 1}, slices.series, {}, rtOf(slices)).ok());
  QCOMPARE(ReadObject(rtOf(slices)).data().getOriginalXfer(), EXS_LittleEndianImplicit);
  const auto out = readSegments(rtOf(slices), slices.series, slices.grid);
  QVERIFY2(out, out ? "" : out.message().c_str());
  QVERIFY(out->maps[0].labels == in.labels);
}

void TestRtstructWritten::segmentsWithoutPixelsAreLeftOut() {
  Chance chance(3);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  const std::string longName(70, 'x');
  Segmented in{{{.number = 1, .label = "Nothing"}, {.number = 2, .label = longName}, {.number = 3}},
               LabelMap(slices.grid)};
  LabelEdit edit(in.labels);
  edit.set({1, 1, 1}, 2);
  edit.set({3, 3, 1}, 3);
  in.labels = edit.done();
  const auto notes = writeStructureSet({&in, 1}, slices.series, {}, rtOf(slices));
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QVERIFY(isSaid(*notes, "Left out, for they have no pixel on the acquired slices: Nothing"));
  QVERIFY(isSaid(*notes, "at most 64 characters"));
  const auto set = loadContours(rtOf(slices));
  QVERIFY(set && set->regions.size() == 2 && set->warnings.empty());
  QCOMPARE(set->regions[0].name, longName.substr(0, 64));
  QCOMPARE(set->regions[1].name, std::string("Segment 3"));
}

void TestRtstructWritten::namesStayAsTheyAre() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  const NamedSlices source(set.toStdString(), name.toStdString());
  Segmented in{{{.number = 1, .label = "Liver"}}, LabelMap(source.series.acquired)};
  in.labels = withLabel(in.labels, 1, inverted(BitMask(source.series.acquired)));
  QVERIFY(writeStructureSet({&in, 1}, source.series, {}, source.out()).ok());
  QCOMPARE(notAsInSource(source.out(), source.series.files[0]).join(QLatin1Char(10)), QString());
  COMPARE_WITH_STANDARD(source.out(), source.series.files[0]);
  in.segments[0].label = "\xe5\xbf\x83\xe8\x87\x93";  // which only UTF-8 and GB18030 hold beside any name
  const std::string other = source.folder.path("other.dcm");
  QVERIFY(writeStructureSet({&in, 1}, source.series, {}, other).ok());
  QCOMPARE(ReadObject(other)[DCM_SpecificCharacterSet],
           std::string(set == "GB18030" ? "GB18030" : "ISO_IR 192"));
  const auto study = openStudy(other);
  QVERIFY(study && study->derived.size() == 1);
  QCOMPARE(study->derived[0].patientName, source.series.patientName);
  const auto regions = loadContours(other);
  QVERIFY(regions && regions->regions[0].name == in.segments[0].label);
}

void TestRtstructWritten::whatCannotBeWrittenIsRefused() {
  Chance chance(1);
  const Slices slices({4, 4}, even(3, 1), chance);
  Segmented in{{{.number = 1, .label = "a"}}, LabelMap(slices.grid)};
  const auto refused = [&](const Series& series, const std::string& path, const char* words,
                           const CancelToken& cancel = {}) {
    const auto notes = writeStructureSet({&in, 1}, series, {}, path, {}, cancel);
    return !notes && notes.message().find(words) != std::string::npos;
  };
  const QStringList before = allFilesIn(slices.folder.path());
  QVERIFY(refused(slices.series, rtOf(slices), "Nothing is marked"));
  QVERIFY(!writeStructureSet({}, slices.series, {}, rtOf(slices)).ok());
  in.labels = withLabel(in.labels, 1, inverted(BitMask(slices.grid)));
  const auto phantom = openStudy("phantom:ct-head:32");
  QVERIFY(phantom && refused(phantom->volumes[0], rtOf(slices), "comes from no DICOM files"));
  QVERIFY(refused(slices.series, slices.folder.path("none/a.dcm"), "no such folder"));
  const CancelToken cancelled;
  cancelled.cancel();
  QVERIFY(refused(slices.series, rtOf(slices), "nterrupted", cancelled));
  QCOMPARE(allFilesIn(slices.folder.path()), before);
  writeAll(rtOf(slices), {1});
  QVERIFY(refused(slices.series, rtOf(slices), "is there already"));
  QVERIFY(readAll(rtOf(slices)) == std::vector<std::uint8_t>({1}));
}

void TestRtstructWritten::aFullDiskKeepsNothing() {
  Chance chance(1);
  const Slices slices({100, 100}, even(3, 1), chance);
  Segmented in{{{.number = 1, .label = "a"}}, LabelMap(slices.grid)};
  in.labels = withLabel(in.labels, 1, randomMask(slices.grid, chance));
  const QTemporaryDir disk;
  const QByteArray folder = disk.path().toUtf8();
  MOUNT_DISK(folder.constData(), 0, "size=8k");
  const std::string path = disk.filePath(QStringLiteral("a.dcm")).toStdString();
  const auto done = writeStructureSet({&in, 1}, slices.series, {}, path);
  const QStringList left = allFilesIn(folder.toStdString());
  QCOMPARE(umount(folder.constData()), 0);
  QVERIFY(!done && done.message().find("a.dcm") != std::string::npos);
  QCOMPARE(left, QStringList());
}

VOLUMEN_TEST(TestRtstructWritten);
#include "tst_rtstruct_written.moc"
