// Guards export/segmentation_dicom.h: the contents of a DICOM SEG about segments and pictures, also on other
// grids and with missing pictures. Also covers refusals. dciodvfy finds no error in segmentations of real
// series.
#include <QElapsedTimer>
#include <QFile>
#include <set>

#include "io/export/segmentation_dicom.h"
#include "io/load.h"
#include "io/segmentation.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/segmentation_slices.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentationDicom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsNotSaidIsFilledIn();
  void itNamesItsPictures();
  void sameContentsGiveTheSameFile();
  void slicesBetweenPicturesAreLeftOutAndTold();
  void labelsOfAnotherGridAreThoseOfTheNearestVoxel();
  void framesOfOneFileAreNamed();
  void whatCannotBeWrittenIsRefused();
  void cancelledWritingLeavesNothing();
  void realSeriesAreValid_data();
  void realSeriesAreValid();
};

void TestSegmentationDicom::whatIsNotSaidIsFilledIn() {
  Chance chance(3);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  BitMask mask(slices.grid);
  mask.set({1, 2, 3});
  const std::string longName(70, 'x');
  std::vector<SegmentVoxels> in;
  for (const std::string& name : {std::string("bone"), std::string(), longName, std::string("a\\b\nc")})
    in.push_back({{.number = 9, .label = name}, mask});
  in[0].segment.range = ValueRange{150, 3000};
  in[0].segment.trackingId = "lesion 1";
  in[1].segment.type = tissueNamed("Liver")->type;  // without a category or a colour
  const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QVERIFY(isSaid(*notes, "Written as Tissue, for there is no code of them: bone, "));
  QVERIFY(isSaid(*notes, "at most 64 characters"));
  const auto out = loadSegmentation(slices.seg());
  QVERIFY(out.ok());
  const std::vector<Segment>& said = out->segments;
  QCOMPARE(said[0].type.meaning, std::string("Tissue"));
  QCOMPARE(said[0].algorithm, std::string("Values from 150 to 3000"));
  QCOMPARE(said[0].trackingId, std::string("lesion 1"));
  QCOMPARE(said[1].label, std::string("Segment 2"));
  QCOMPARE(said[1].category.meaning, std::string("Anatomical Structure"));
  QVERIFY(said[1].colour == tissueNamed("Liver")->colour);
  QCOMPARE(said[2].label, longName.substr(0, 64));
  QCOMPARE(said[3].label, std::string("a b c"));
  QVERIFY(said[0].number == 1 && said[3].number == 4);
}

void TestSegmentationDicom::itNamesItsPictures() {
  Chance chance(3);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  BitMask mask(slices.grid);
  mask.set({1, 2, 3});
  const std::vector<SegmentVoxels> in{{randomSegment(1, chance), mask}, {randomSegment(2, chance), mask}};
  const SegmentationTags tags{.description = "Bones", .date = "20260102", .time = "030405"};
  QVERIFY(writeSegmentationDicom(in, slices.series, tags, slices.seg()).ok());
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(slices.seg().c_str())).good());
  DcmDataset& data = *file.getDataset();
  QCOMPARE(attributeText(data, DCM_PatientID), std::string("P1"));
  QCOMPARE(attributeText(data, DCM_StudyInstanceUID), std::string("1.2.3.4"));
  QCOMPARE(attributeText(data, DCM_ReferringPhysicianName), std::string("Doctor^A"));
  QCOMPARE(attributeText(data, DCM_FrameOfReferenceUID), std::string("1.2.3.7"));
  QCOMPARE(attributeText(data, DCM_SeriesDescription), std::string("Bones"));
  QCOMPARE(attributeText(data, DCM_ContentDate), std::string("20260102"));
  QCOMPARE(attributeText(data, DCM_SegmentsOverlap), std::string("YES"));
  QVERIFY(attributeText(data, DCM_SeriesInstanceUID) != "1.2.3.4.5");
  DcmItem* measures = itemOf(itemOf(&data, DCM_SharedFunctionalGroupsSequence), DCM_PixelMeasuresSequence);
  for (const DcmTagKey& tag : {DCM_SliceThickness, DCM_SpacingBetweenSlices})  // positions have 12 digits
    QVERIFY(std::abs(QString::fromStdString(attributeText(*measures, tag)).toDouble() - 2.5) < 1e-6);
  // All source instances are listed, and for the frame the one it lies on.
  DcmItem* series = itemOf(&data, DCM_ReferencedSeriesSequence);
  QCOMPARE(attributeText(*series, DCM_SeriesInstanceUID), std::string("1.2.3.4.5"));
  std::set<std::string> instances;
  for (long n = 0; DcmItem* instance = itemOf(series, DCM_ReferencedInstanceSequence, n); ++n)
    instances.insert(attributeText(*instance, DCM_ReferencedSOPInstanceUID));
  const auto& uids = slices.series.sopInstanceUids;
  QVERIFY(instances == std::set<std::string>(uids.begin(), uids.end()));
  DcmItem* source =
      itemOf(itemOf(itemOf(&data, DCM_PerFrameFunctionalGroupsSequence), DCM_DerivationImageSequence),
             DCM_SourceImageSequence);
  QCOMPARE(attributeText(*source, DCM_ReferencedSOPInstanceUID), uids[3]);
  QCOMPARE(attributeText(*source, DCM_SpatialLocationsPreserved), std::string("YES"));
}

void TestSegmentationDicom::sameContentsGiveTheSameFile() {
  Chance chance(4);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  const std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(BitMask(slices.grid))}};
  const auto written = [&](const SegmentationTags& tags) {
    QFile file(QString::fromStdString(slices.seg()));
    const bool done = writeSegmentationDicom(in, slices.series, tags, slices.seg()).ok();
    return done && file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  };
  const auto instanceOf = [&] {
    DcmFileFormat file;
    return file.loadFile(OFFilename(slices.seg().c_str())).good()
               ? attributeText(*file.getDataset(), DCM_SOPInstanceUID)
               : std::string();
  };
  const QByteArray first = written({.date = "20260102", .time = "030405"});
  const std::string instance = instanceOf();
  QVERIFY(!first.isEmpty() && written({.date = "20260102", .time = "030405"}) == first);
  QVERIFY(written({.date = "20260102", .time = "030406"}) != first && instanceOf() != instance);
}

void TestSegmentationDicom::slicesBetweenPicturesAreLeftOutAndTold() {
  Chance chance(11);
  const Slices slices({8, 8}, {0, 2, 4, 8, 10, 12}, chance);  // the slice at 6 is missing
  QVERIFY(slices.series.regular.has_value());
  QCOMPARE(slices.grid.size.z, 7);
  std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(BitMask(slices.grid))}};
  const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QCOMPARE(notes->size(), std::size_t(1));
  QVERIFY2(isSaid(*notes, "no picture of the series: 1;"), notes->front().c_str());
  const auto out = loadSegmentation(slices.seg());
  QVERIFY(out.ok());
  QCOMPARE(out->frames.size(), std::size_t(6));
  QCOMPARE(pixelsOf(*out, 0), std::int64_t(6 * 64));
  // Without marked voxels in that slice there is no note.
  BitMask last(slices.grid);
  last.set({0, 0, 6});
  in[0].mask = last;
  const auto silent = writeSegmentationDicom(in, slices.series, {}, slices.seg());
  QVERIFY(silent && silent->empty());
  QVERIFY(maskOf(*loadSegmentation(slices.seg()), 0, slices.grid) == last);
}

void TestSegmentationDicom::labelsOfAnotherGridAreThoseOfTheNearestVoxel() {
  const Seeds seeds = seedsOf(40, 400);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const Slices slices({1 + chance.below(20), 1 + chance.below(20)}, even(1 + chance.below(5), 1.5), chance);
    VoxelGeometry grid;
    grid.size = {1 + chance.below(20), 1 + chance.below(20), 1 + chance.below(9)};
    grid.patientFromVoxelStep = slices.grid.patientFromVoxelStep * chance.between(0.4, 1.7) +
                                0.1 * glm::dmat3(chance.vector(), chance.vector(), chance.vector());
    grid.origin = slices.grid.origin + chance.vector();
    std::vector<SegmentVoxels> in{{randomSegment(1, chance), inverted(randomMask(grid, chance))}};
    BitMask expected(slices.grid);
    for (int k = 0; k < slices.grid.size.z; ++k)
      for (int j = 0; j < slices.grid.size.y; ++j)
        for (int i = 0; i < slices.grid.size.x; ++i) {
          const glm::dvec3 p = glm::round(grid.voxelFromPatient(slices.grid.patientFromVoxel({i, j, k})));
          const bool inside =
              p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < grid.size.x && p.y < grid.size.y && p.z < grid.size.z;
          expected.set({i, j, k}, inside && in[0].mask.at(glm::ivec3(p)));
        }
    const auto notes = writeSegmentationDicom(in, slices.series, {}, slices.seg());
    QCOMPARE(notes.ok(), !expected.empty());
    if (!notes) continue;
    QVERIFY2(isSaid(*notes, "another grid"), qPrintable(QString::number(seed)));
    QVERIFY2(maskOf(*loadSegmentation(slices.seg()), 0, slices.grid) == expected,
             qPrintable(QString::number(seed)));
  }
}

void TestSegmentationDicom::framesOfOneFileAreNamed() {
  NEED_DATA(dataPath());
  const auto study = openStudy(dataPath("dicom-geometry/mr-enh-siemens-xa10"));
  QVERIFY(study && !study->volumes.empty());
  const Series& series = study->volumes[0];
  BitMask mask(series.acquired);
  mask.set({5, 6, series.acquired.size.z - 1});
  const DicomFolder folder;
  const std::string path = folder.path("a.dcm");
  const std::vector<SegmentVoxels> in{{{.number = 1, .label = "a"}, mask}};
  const auto notes = writeSegmentationDicom(in, series, {}, path);
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(path.c_str())).good());
  DcmItem* source = itemOf(
      itemOf(itemOf(file.getDataset(), DCM_PerFrameFunctionalGroupsSequence), DCM_DerivationImageSequence),
      DCM_SourceImageSequence);
  QCOMPARE(attributeText(*source, DCM_ReferencedFrameNumber), std::to_string(series.frames.back() + 1));
  QVERIFY(maskOf(*loadSegmentation(path), 0, series.acquired) == mask);
}

void TestSegmentationDicom::whatCannotBeWrittenIsRefused() {
  Chance chance(1);
  const Slices slices({4, 4}, even(3, 1), chance);
  std::vector<SegmentVoxels> in{{{.number = 1, .label = "a"}, BitMask(slices.grid)}};
  const auto refused = [&](const Series& series, const std::string& path, const char* words) {
    const auto notes = writeSegmentationDicom(in, series, {}, path);
    return !notes && notes.message().find(words) != std::string::npos &&
           !QFile::exists(QString::fromStdString(path));
  };
  QVERIFY(refused(slices.series, slices.seg(), "Nothing is marked"));
  QVERIFY(!writeSegmentationDicom(std::span<const Segmented>(), slices.series, {}, slices.seg()).ok());
  in[0].mask.set({0, 0, 0});
  const auto phantom = openStudy("phantom:ct-head:32");
  QVERIFY(phantom.ok());
  QVERIFY(refused(phantom->volumes[0], slices.seg(), "comes from no DICOM files"));
  QVERIFY(refused(slices.series, slices.folder.path("none/a.dcm"), "no such folder"));
  Series gone = slices.series;
  gone.files[1] = slices.folder.path("gone");
  QVERIFY(refused(gone, slices.seg(), "gone"));
}

void TestSegmentationDicom::cancelledWritingLeavesNothing() {
  Chance chance(1);
  const Slices slices({4, 4}, even(3, 1), chance);
  const std::vector<SegmentVoxels> in{{{.number = 1}, inverted(BitMask(slices.grid))}};
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(!writeSegmentationDicom(in, slices.series, {}, slices.seg(), {}, cancel).ok());
  QVERIFY(!QFile::exists(QString::fromStdString(slices.seg())));
}

void TestSegmentationDicom::realSeriesAreValid_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "mr-head-siemens-gap-175",
                           "dicom-geometry/ct-head-slicer-93"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// Two segments by thresholds, over all slices. VOLUMEN_FIGURES prints the time of each step.
void TestSegmentationDicom::realSeriesAreValid() {
  QFETCH(QString, name);
  NEED_DATA(dataPath(name.toStdString()));
  const auto study = openStudy(dataPath(name.toStdString()));
  QVERIFY(study && !study->volumes.empty());
  const Series& series = study->volumes[0];
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  const Volume& volume = *loaded->drawn;
  const VoxelGeometry& grid = volume.geometry();
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  for (std::size_t n = 0; n < dense.labels.size(); ++n)
    dense.labels[n] = volume.valueAt(n) > 200 ? 2 : volume.valueAt(n) > 20;
  Segmented in{{{.number = 1, .label = "Muscle"}, {.number = 2, .label = "Bone"}}, LabelMap(dense)};
  for (Segment& segment : in.segments) {
    segment.category = tissueNamed(segment.label)->category;
    segment.type = tissueNamed(segment.label)->type;
  }
  const DicomFolder folder;
  const std::string path = folder.path("a.dcm");
  QElapsedTimer timer;
  timer.start();
  const auto notes = writeSegmentationDicom({&in, 1}, series, {}, path);
  const qint64 writing = timer.restart();
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  const auto out = loadSegmentation(path);
  QVERIFY2(out, out ? "" : out.message().c_str());
  const qint64 reading = timer.restart();
  const std::vector<Segmented> maps = segmentedOf(*out, grid);
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    qInfo("%s: %d x %d x %d: written %lld ms, read %lld ms, on the grid %lld ms", qPrintable(name),
          grid.size.x, grid.size.y, grid.size.z, static_cast<long long>(writing),
          static_cast<long long>(reading), static_cast<long long>(timer.elapsed()));
  QCOMPARE(maps.size(), std::size_t(1));
  if (!series.regular) QVERIFY(maps[0].labels == in.labels);
  QCOMPARE(isSaid(*notes, "138 frames of reference"), name.startsWith(QStringLiteral("ct-chest")));
  NEED_DCIODVFY();
  const QStringList errors = dciodvfyErrors(QString::fromStdString(path));
  QVERIFY2(errors.isEmpty(), qPrintable(errors.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestSegmentationDicom);
#include "tst_segmentation_dicom.moc"
