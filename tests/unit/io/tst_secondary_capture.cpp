// Guards export/secondary_capture.h, encapsulated_pdf.h and study_object.h: pictures and documents come back
// as they were, in the study of their series, whatever its modality and the letters of its names; nothing is
// replaced, and what fails leaves nothing.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QFile>
#include <set>

#include "io/export/encapsulated_pdf.h"
#include "io/export/secondary_capture.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/io/study_sources.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Rgb = std::vector<std::uint8_t>;

// Noise with long runs, so that both kinds of RLE packets occur.
Rgb randomPicture(glm::ivec2 size, Chance& chance) {
  Rgb rgb(std::size_t(size.x) * std::size_t(size.y) * 3);
  std::uint8_t value = 0;
  for (std::uint8_t& byte : rgb) {
    if (!chance.oneIn(1 + chance.below(4))) value = std::uint8_t(chance.below(256));
    byte = value;
  }
  return rgb;
}

Status writeCapture(const std::string& path, const Series& series, const CaptureTags& tags, glm::ivec2 size,
                    const std::vector<Rgb>& frames) {
  auto capture = SecondaryCapture::begin(path, series, tags, size, int(frames.size()));
  if (!capture) return capture.error();
  for (const Rgb& frame : frames)
    if (Status s = capture->add(frame); !s) return s;
  return capture->finish();
}

// Returns all pixels as DCMTK decodes them.
Rgb pixelsByDcmtk(ReadObject& object) {
  DcmRLEDecoderRegistration::registerCodecs();
  object.data().chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  const Uint8* bytes = nullptr;
  unsigned long count = 0;
  if (object.data().findAndGetUint8Array(DCM_PixelData, bytes, &count).bad() || !bytes) return {};
  return {bytes, bytes + count};
}

const std::string pdfBytes = "%PDF-1.4\nof a report\n%%EOF\n";  // 27 bytes: an odd number

}  // namespace

class TestSecondaryCapture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void realSourcesGiveValidObjects_data() { addRealSources(); }
  void realSourcesGiveValidObjects();
  void randomPicturesComeBack();
  void flagsAndReferencesAreThoseOfTheCaller();
  void nothingCanBeMeasured();
  void namesStayAsTheyAre_data() { addNames(); }
  void namesStayAsTheyAre();
  void lettersThatTheSetLacksMakeItUtf8();
  void eachObjectIsNewInItsStudy();
  void whatIsThereIsNotReplaced();
  void wrongFramesAreRefused();
  void otherSourcesAreRefused();
  void aFullDiskKeepsNothing();
  void aFolderThatCannotBeWrittenStaysAsItIs();
  void pdfComesBack();
  void pdfIsRefused();
};

void TestSecondaryCapture::realSourcesGiveValidObjects() {
  QFETCH(QString, source);
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath(source.toStdString()));
  QVERIFY(!series.files.empty());
  Chance chance(1);
  const glm::ivec2 size(13, 7);
  const QTemporaryDir folder;
  for (const int count : {1, 3})
    for (const bool rle : {false, true}) {
      std::vector<Rgb> frames;
      for (int n = 0; n < count; ++n) frames.push_back(randomPicture(size, chance));
      const std::string path =
          folder.filePath(QStringLiteral("sc%1%2.dcm").arg(count).arg(rle)).toStdString();
      CaptureTags tags;
      tags.description = "Rendering";
      tags.derivation = "Scene 1234, level standard, error 0.2/255";
      tags.rle = rle;
      const Status done = writeCapture(path, series, tags, size, frames);
      QVERIFY2(done, done ? "" : done.message().c_str());
      COMPARE_WITH_STANDARD(path, series.files[0]);
      QCOMPARE(notAsInSource(path, series.files[0]).join(QLatin1Char(10)), QString());
      for (int n = 0; n < count; ++n) {
        const auto frame = frameOf(path, n);
        QVERIFY2(frame, frame ? "" : frame.message().c_str());
        QVERIFY(frame->size == size && frame->rgb == frames[std::size_t(n)]);
      }
      ReadObject object(path);
      QCOMPARE(object[DCM_SOPClassUID],
               std::string(count > 1 ? "1.2.840.10008.5.1.4.1.1.7.4" : "1.2.840.10008.5.1.4.1.1.7"));
      QCOMPARE(object.file.getDataset()->getOriginalXfer(), rle ? EXS_RLELossless : EXS_LittleEndianExplicit);
    }
  const std::string document = folder.filePath(QStringLiteral("pdf.dcm")).toStdString();
  const Status done = writeEncapsulatedPdf(pdfBytes, series, {}, document);
  QVERIFY2(done, done ? "" : done.message().c_str());
  COMPARE_WITH_STANDARD(document, series.files[0]);
  QCOMPARE(notAsInSource(document, series.files[0]).join(QLatin1Char(10)), QString());
}

// By DCMTK's decoder, in seeded sizes, also of one row, one column and an odd number of bytes.
void TestSecondaryCapture::randomPicturesComeBack() {
  const NamedSlices in;
  const Seeds seeds = seedsOf(100, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const glm::ivec2 size(1 + chance.below(chance.oneIn(4) ? 300 : 9), 1 + chance.below(12));
    std::vector<Rgb> frames;
    for (int n = 1 + chance.below(4); n > 0; --n) frames.push_back(randomPicture(size, chance));
    CaptureTags tags;
    tags.rle = chance.oneIn(2);
    QVERIFY(writeCapture(in.out(), in.series, tags, size, frames));
    ReadObject object(in.out());
    Rgb expected;
    for (const Rgb& frame : frames) expected.insert(expected.end(), frame.begin(), frame.end());
    Rgb read = pixelsByDcmtk(object);
    QVERIFY(read.size() - expected.size() <= 1);
    read.resize(expected.size());
    QVERIFY2(read == expected, qPrintable(QString::number(seed)));
    QVERIFY(QFile::remove(QString::fromStdString(in.out())));
  }
}

void TestSecondaryCapture::flagsAndReferencesAreThoseOfTheCaller() {
  const NamedSlices in;
  const Rgb picture(12, 9);
  CaptureTags tags;
  tags.derivation = std::string(2000, 'x');
  tags.hasNames = false;
  tags.showsFace = true;
  tags.frameMs = 40;
  tags.slices = {2};
  QVERIFY(writeCapture(in.out(), in.series, tags, {2, 2}, {picture, picture}));
  ReadObject object(in.out());
  QCOMPARE(object[DCM_BurnedInAnnotation], std::string("NO"));
  QCOMPARE(object[DCM_RecognizableVisualFeatures], std::string("YES"));
  QCOMPARE(object[DCM_FrameTime], std::string("40"));
  QCOMPARE(object[DCM_CineRate], std::string("25"));
  QCOMPARE(object[DCM_StopTrim], std::string("2"));
  QCOMPARE(object[DCM_FrameIncrementPointer], std::string("(0018,1063)"));
  QCOMPARE(object[DCM_DerivationDescription], std::string(1024, 'x'));
  QCOMPARE(object[DCM_ImageType], std::string("DERIVED\\SECONDARY"));
  DcmItem* source = object.item(DCM_SourceImageSequence);
  QVERIFY(source && !object.item(DCM_SourceImageSequence, 1));
  OFString uid, purpose;
  DcmItem* code = nullptr;
  QVERIFY(source->findAndGetOFString(DCM_ReferencedSOPInstanceUID, uid).good());
  QCOMPARE(std::string(uid.c_str()), in.series.sopInstanceUids[2]);
  QVERIFY(source->findAndGetSequenceItem(DCM_PurposeOfReferenceCodeSequence, code).good());
  QVERIFY(code->findAndGetOFString(DCM_CodeValue, purpose).good() && purpose == "121322");
}

void TestSecondaryCapture::nothingCanBeMeasured() {
  const NamedSlices in;
  QVERIFY(writeCapture(in.out(), in.series, {}, {2, 2}, {Rgb(12, 9)}));
  ReadObject object(in.out());
  for (const DcmTagKey& tag :
       {DCM_PixelSpacing, DCM_ImagerPixelSpacing, DCM_NominalScannedPixelSpacing, DCM_PixelAspectRatio,
        DCM_WindowCenter, DCM_WindowWidth, DCM_RescaleSlope, DCM_RescaleIntercept, DCM_ImagePositionPatient,
        DCM_ImageOrientationPatient, DCM_SliceThickness, DCM_FrameOfReferenceUID})
    QVERIFY2(!object.has(tag), DcmTag(tag).getTagName());
}

// The bytes of the names and the character set are those of the source; new texts are in it, too.
void TestSecondaryCapture::namesStayAsTheyAre() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  const NamedSlices in(set.toStdString(), name.toStdString());
  QVERIFY(!in.series.files.empty());
  CaptureTags tags;
  tags.description = "View from ahead";
  QVERIFY(writeCapture(in.out(), in.series, tags, {2, 2}, {Rgb(12, 9)}));
  ReadObject object(in.out());
  QCOMPARE(object[DCM_SpecificCharacterSet], set.toStdString());
  QCOMPARE(object[DCM_PatientName], name.toStdString());
  QCOMPARE(object[DCM_ReferringPhysicianName], name.toStdString());
  QCOMPARE(object[DCM_SeriesDescription], tags.description);
  const auto study = openStudy(in.out());
  QVERIFY(study && study->images.size() == 1);
  QCOMPARE(study->images[0].patientName, in.series.patientName);
  COMPARE_WITH_STANDARD(in.out(), in.series.files[0]);
}

void TestSecondaryCapture::lettersThatTheSetLacksMakeItUtf8() {
  for (const auto& [description, set] : {std::pair("Ansicht f\xc3\xbcr Ren\xc3\xa9", "ISO_IR 100"),
                                         {"\xe5\xbf\x83\xe8\x87\x93", "ISO_IR 192"}}) {
    const NamedSlices in("ISO_IR 100",
                         "Nu\xf1"
                         "ez^Ren\xe9");
    CaptureTags tags;
    tags.description = description;
    QVERIFY(writeCapture(in.out(), in.series, tags, {2, 2}, {Rgb(12, 9)}));
    QCOMPARE(ReadObject(in.out())[DCM_SpecificCharacterSet], std::string(set));
    const auto study = openStudy(in.out());
    QVERIFY(study && study->images.size() == 1);
    QCOMPARE(study->images[0].patientName, in.series.patientName);
    QCOMPARE(study->images[0].description, std::string(description));
  }
}

void TestSecondaryCapture::eachObjectIsNewInItsStudy() {
  const NamedSlices in;
  std::set<std::string> uids{in.series.seriesUid};
  for (int n = 0; n < 20; ++n) {
    QVERIFY(writeCapture(in.out(), in.series, {}, {2, 2}, {Rgb(12, 9)}));
    ReadObject object(in.out());
    QCOMPARE(object[DCM_SeriesNumber], std::string("8"));
    for (const DcmTagKey& tag : {DCM_SOPInstanceUID, DCM_SeriesInstanceUID}) {
      QVERIFY(QString::fromStdString(object[tag]).startsWith(QStringLiteral("2.25.")));
      QVERIFY(object[tag].size() <= 64 && uids.insert(object[tag]).second);
    }
    QVERIFY(QFile::remove(QString::fromStdString(in.out())));
  }
  CaptureTags tags;
  tags.seriesNumber = nextSeriesNumber(in.folder.open(), in.series.studyUid);
  QCOMPARE(tags.seriesNumber, 8);
  QVERIFY(writeCapture(in.out(), in.series, tags, {2, 2}, {Rgb(12, 9)}));
  QCOMPARE(nextSeriesNumber(in.folder.open(), in.series.studyUid), 9);
  QCOMPARE(nextSeriesNumber(in.folder.open(), "1.2.another"), 1);
  Study full = in.folder.open();
  for (const char* number : {"2147483647", "2147483646", "7"}) {
    full.volumes.push_back(full.volumes[0]);
    full.volumes.back().seriesNumber = number;
  }
  QCOMPARE(nextSeriesNumber(full, in.series.studyUid), 2147483645);
}

void TestSecondaryCapture::whatIsThereIsNotReplaced() {
  const NamedSlices in;
  const auto refusal = [&](const Status& s) { return s ? std::string() : s.message(); };
  writeAll(in.out(), {1, 2, 3});
  QVERIFY(refusal(writeCapture(in.out(), in.series, {}, {2, 2}, {Rgb(12, 9)})).find("is there already") !=
          std::string::npos);
  QVERIFY(refusal(writeEncapsulatedPdf(pdfBytes, in.series, {}, in.out())).find("is there already") !=
          std::string::npos);
  QVERIFY(readAll(in.out()) == std::vector<std::uint8_t>({1, 2, 3}));
  // Made by another program while the frames came.
  const std::string late = in.folder.path("late.dcm");
  auto capture = SecondaryCapture::begin(late, in.series, {}, {2, 2}, 1);
  QVERIFY(capture && capture->add(Rgb(12, 9)));
  writeAll(late, {4});
  QVERIFY(refusal(capture->finish()).find("is there already") != std::string::npos);
  QVERIFY(readAll(late) == std::vector<std::uint8_t>({4}));
}

void TestSecondaryCapture::wrongFramesAreRefused() {
  const NamedSlices in;
  const QStringList before = allFilesIn(in.folder.path());
  for (const glm::ivec2 size : {glm::ivec2(0, 2), glm::ivec2(2, 65536), glm::ivec2(40000, 40000)})
    QVERIFY(!SecondaryCapture::begin(in.out(), in.series, {}, size, 1));
  QVERIFY(!SecondaryCapture::begin(in.out(), in.series, {}, {2, 2}, 0));
  {
    auto capture = SecondaryCapture::begin(in.out(), in.series, {}, {2, 2}, 2);
    QVERIFY(capture && !capture->add(Rgb(11, 9)) && capture->add(Rgb(12, 9)));
    QVERIFY(capture->finish().message().find("1 of its frames are missing") != std::string::npos);
    QVERIFY(capture->add(Rgb(12, 9)) && !capture->add(Rgb(12, 9)));
  }
  QCOMPARE(allFilesIn(in.folder.path()), before);
}

void TestSecondaryCapture::otherSourcesAreRefused() {
  const NamedSlices in;
  const auto phantom = openStudy("phantom:ct-head:32");
  QVERIFY(phantom.ok());
  const Status none = writeCapture(in.out(), phantom->volumes[0], {}, {2, 2}, {Rgb(12, 9)});
  QVERIFY(!none && none.message().find("comes from no DICOM files") != std::string::npos);
  Series gone = in.series;
  gone.files[1] = in.folder.path("gone");
  const Status lost = writeEncapsulatedPdf(pdfBytes, gone, {}, in.out());
  QVERIFY(!lost && lost.message().find("gone") != std::string::npos);
  QVERIFY(!QFile::exists(QString::fromStdString(in.out())));
}

void TestSecondaryCapture::aFullDiskKeepsNothing() {
  const NamedSlices in;
  const QTemporaryDir disk;
  const QByteArray folder = disk.path().toUtf8();
  MOUNT_DISK(folder.constData(), 0, "size=64k");
  const std::string path = disk.filePath(QStringLiteral("a.dcm")).toStdString();
  const glm::ivec2 size(200, 200);
  const Status done = writeCapture(path, in.series, {}, size, std::vector<Rgb>(5, Rgb(120000, 9)));
  const Status document = writeEncapsulatedPdf(pdfBytes + std::string(200000, ' '), in.series, {}, path);
  const QStringList left = allFilesIn(folder.toStdString());
  QCOMPARE(umount(folder.constData()), 0);
  QVERIFY(!done && done.message().find("a.dcm") != std::string::npos);
  QVERIFY(!document && document.message().find("a.dcm") != std::string::npos);
  QCOMPARE(left, QStringList());
}

void TestSecondaryCapture::aFolderThatCannotBeWrittenStaysAsItIs() {
  const NamedSlices in;
  const QTemporaryDir disk;
  const QByteArray folder = disk.path().toUtf8();
  MOUNT_DISK(folder.constData(), MS_RDONLY, nullptr);
  const std::string path = disk.filePath(QStringLiteral("a.dcm")).toStdString();
  const Status done = writeCapture(path, in.series, {}, {2, 2}, {Rgb(12, 9)});
  const Status document = writeEncapsulatedPdf(pdfBytes, in.series, {}, path);
  const QStringList left = allFilesIn(folder.toStdString());
  QCOMPARE(umount(folder.constData()), 0);
  QVERIFY(!done && !document);
  QCOMPARE(left, QStringList());
}

void TestSecondaryCapture::pdfComesBack() {
  const NamedSlices in;
  PdfTags tags;
  tags.title = "Report of 2026";
  tags.hasNames = false;
  QVERIFY(writeEncapsulatedPdf(pdfBytes, in.series, tags, in.out()));
  ReadObject object(in.out());
  QCOMPARE(object[DCM_SOPClassUID], std::string("1.2.840.10008.5.1.4.1.1.104.1"));
  QCOMPARE(object[DCM_Modality], std::string("DOC"));
  QCOMPARE(object[DCM_MIMETypeOfEncapsulatedDocument], std::string("application/pdf"));
  QCOMPARE(object[DCM_DocumentTitle], tags.title);
  QCOMPARE(object[DCM_BurnedInAnnotation], std::string("NO"));
  Uint32 length = 0;
  const Uint8* bytes = nullptr;
  unsigned long count = 0;
  QVERIFY(object.data().findAndGetUint32(DcmTagKey(0x0042, 0x0015), length).good());
  QVERIFY(object.data().findAndGetUint8Array(DCM_EncapsulatedDocument, bytes, &count).good());
  QCOMPARE(std::size_t(length), pdfBytes.size());
  QCOMPARE(std::size_t(count), pdfBytes.size() + 1);
  QCOMPARE(std::string(bytes, bytes + length), pdfBytes);
  for (long n = 0; n < 3; ++n) {
    OFString uid;
    DcmItem* source = object.item(DcmTagKey(0x0042, 0x0013), n);
    QVERIFY(source && source->findAndGetOFString(DCM_ReferencedSOPInstanceUID, uid).good());
    QCOMPARE(std::string(uid.c_str()), in.series.sopInstanceUids[std::size_t(n)]);
  }
  QVERIFY(!object.item(DcmTagKey(0x0042, 0x0013), 3));
}

void TestSecondaryCapture::pdfIsRefused() {
  const NamedSlices in;
  const Status none = writeEncapsulatedPdf("no document", in.series, {}, in.out());
  QVERIFY(!none && none.message().find("is no PDF") != std::string::npos);
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(!writeEncapsulatedPdf(pdfBytes, in.series, {}, in.out(), {}, cancel));
  QVERIFY(!QFile::exists(QString::fromStdString(in.out())));
}

VOLUMEN_TEST(TestSecondaryCapture);
#include "tst_secondary_capture.moc"
