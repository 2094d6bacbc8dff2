// Guards design.md 7: facts that distinguish series of one name are read, and all attributes of a file can be
// listed.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QFile>
#include <algorithm>

#include "io/dicom/attribute_list.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesFacts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatTellsSeriesApartIsRead_data();
  void whatTellsSeriesApartIsRead();
  void lossesByCompressionAreRead();
  void attributesAreListedInFileOrder();
  void everyAttributeIsListed_data();
  void everyAttributeIsListed();
  void whatCannotBeListedIsSaid();
};

namespace {

using Edit = void (*)(DcmDataset&);

const dicom::AttributeLine* lineOf(const std::vector<dicom::AttributeLine>& lines, const std::string& tag) {
  const auto at = std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.tag == tag; });
  return at == lines.end() ? nullptr : &*at;
}

}  // namespace

Q_DECLARE_METATYPE(Edit)
Q_DECLARE_METATYPE(std::string Series::*)

void TestSeriesFacts::whatTellsSeriesApartIsRead_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<std::string Series::*>("field");
  QTest::addColumn<QString>("value");
  const auto row = [](const char* name, std::string Series::*field, const char* value, Edit edit) {
    QTest::newRow(name) << edit << field << QString::fromLatin1(value);
  };
  row("SOP class", &Series::sopClassUid, UID_MRImageStorage,
      [](DcmDataset& d) { d.putAndInsertString(DCM_SOPClassUID, UID_MRImageStorage); });
  row("echo time", &Series::echoTime, "20.5",
      [](DcmDataset& d) { d.putAndInsertString(DCM_EchoTime, "20.5"); });
  row("no echo time", &Series::echoTime, "", [](DcmDataset&) {});
  row("b-value", &Series::bValue, "1000",
      [](DcmDataset& d) { d.putAndInsertFloat64(DCM_DiffusionBValue, 1000); });
  row("b-value of Siemens", &Series::bValue, "800", [](DcmDataset& d) {
    d.putAndInsertString(DcmTag(0x0019, 0x0010, EVR_LO), "SIEMENS MR HEADER");
    d.putAndInsertString(DcmTag(0x0019, 0x100c, EVR_IS), "800");
  });
  row("b-value of GE", &Series::bValue, "700", [](DcmDataset& d) {
    d.putAndInsertString(DcmTag(0x0043, 0x0010, EVR_LO), "GEMS_PARM_01");
    d.putAndInsertString(DcmTag(0x0043, 0x1039, EVR_IS), "1000000700\\8\\0\\0");
  });
  row("private attributes of somebody else", &Series::bValue, "",
      [](DcmDataset& d) { d.putAndInsertString(DcmTag(0x0019, 0x100c, EVR_IS), "800"); });
  row("time point", &Series::timePoint, "3",
      [](DcmDataset& d) { d.putAndInsertString(DCM_TemporalPositionIdentifier, "3"); });
  row("time of the acquisition", &Series::time, "102231.25", [](DcmDataset& d) {
    d.putAndInsertString(DCM_AcquisitionTime, "102231.25");
    d.putAndInsertString(DCM_SeriesTime, "090000");
  });
  row("time in the old form", &Series::time, "102231.25",
      [](DcmDataset& d) { d.putAndInsertString(DCM_AcquisitionTime, "10:22:31.25"); });
  row("date", &Series::studyDate, "20040119",
      [](DcmDataset& d) { d.putAndInsertString(DCM_StudyDate, "20040119"); });
  row("date in the old form", &Series::studyDate, "19940130",
      [](DcmDataset& d) { d.putAndInsertString(DCM_StudyDate, "1994.01.30"); });
  row("date with dashes", &Series::studyDate, "19940130",
      [](DcmDataset& d) { d.putAndInsertString(DCM_StudyDate, "1994-01-30"); });
  row("what is no date", &Series::studyDate, "1994.1.30",
      [](DcmDataset& d) { d.putAndInsertString(DCM_StudyDate, "1994.1.30"); });
  row("time of the series", &Series::time, "090000",
      [](DcmDataset& d) { d.putAndInsertString(DCM_SeriesTime, "090000"); });
}

void TestSeriesFacts::whatTellsSeriesApartIsRead() {
  QFETCH(Edit, edit);
  QFETCH(std::string Series::*, field);
  QFETCH(QString, value);
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = edit;
    folder.add(numbered("s", n), picture);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(study.volumes[0].*field), value);
}

// Covers a volume with one lossy slice, and frames.
void TestSeriesFacts::lossesByCompressionAreRead() {
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture = sliceAt(n, n);
    if (n == 1)
      picture.edit = [](DcmDataset& d) {
        d.putAndInsertString(DCM_LossyImageCompression, "01");
        d.putAndInsertString(DCM_LossyImageCompressionRatio, "20\\10");
      };
    folder.add(numbered("s", n), picture);
  }
  QCOMPARE(folder.open().volumes.at(0).lossyRatio, std::optional<std::string>("20\\10"));
  const DicomFolder others;
  DicomPicture none = sliceAt(0, 1);
  none.edit = [](DcmDataset& d) { d.putAndInsertString(DCM_LossyImageCompression, "00"); };
  others.add("none", none);
  QVERIFY(!others.open().volumes.at(0).lossyRatio);
  const std::string jpeg = dataPath("dicom-2d/xa-96frames.dcm");
  NEED_DATA(jpeg);
  const Result<Study> study = openStudy(jpeg);
  QVERIFY(study.ok() && study->images.size() == 1);
  QVERIFY2(study->images[0].lossyRatio, "its transfer syntax says it");
}

void TestSeriesFacts::attributesAreListedInFileOrder() {
  const DicomFolder folder;
  DicomPicture picture = sliceAt(1, 7);
  picture.edit = [](DcmDataset& d) {
    d.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 100");
    d.putAndInsertString(DCM_PatientName, "M\xfcller^Eva");
    d.putAndInsertUint16Array(DCM_SmallestImagePixelValue, std::array<Uint16, 1>{300}.data(), 1);
    d.putAndInsertFloat64(DCM_DiffusionBValue, 0.5);
    DcmItem* item = nullptr;
    d.findOrCreateSequenceItem(DCM_ReferencedImageSequence, item, -2);
    item->putAndInsertString(DCM_ReferencedSOPInstanceUID, "1.2.3");
    d.putAndInsertString(DcmTag(0x0029, 0x0010, EVR_LO), "SIEMENS CSA HEADER");
    d.putAndInsertString(DcmTag(0x0029, 0x1008, EVR_CS), "IMAGE NUM 4");
  };
  folder.add("a", picture);
  const auto lines = dicom::listAttributes(folder.path("a"));
  QVERIFY(lines.ok());
  const auto compare = [&](const char* tag, const char* name, const char* vr, const char* value) {
    const dicom::AttributeLine* line = lineOf(*lines, tag);
    QVERIFY2(line, tag);
    QCOMPARE(QString::fromStdString(line->name), QString::fromUtf8(name));
    QCOMPARE(QString::fromStdString(line->vr), QString::fromUtf8(vr));
    QCOMPARE(QString::fromStdString(line->value), QString::fromUtf8(value));
  };
  compare("(0002,0010)", "TransferSyntaxUID", "UI", "1.2.840.10008.1.2.1");
  compare("(0010,0010)", "PatientName", "PN", "Müller^Eva");
  compare("(0018,9087)", "DiffusionBValue", "FD", "0.5");
  compare("(0028,0106)", "SmallestImagePixelValue", "US", "300");
  compare("(0008,1140)", "ReferencedImageSequence", "SQ", "1 item");
  compare("(0029,0010)", "PrivateCreator", "LO", "SIEMENS CSA HEADER");
  compare("(0029,1008)", "CSAImageHeaderType", "CS", "IMAGE NUM 4");
  compare("(7FE0,0010)", "PixelData", "OW", "24 bytes");
  const dicom::AttributeLine* inItem = lineOf(*lines, "(0008,1155)");
  QVERIFY(inItem);
  QCOMPARE(inItem->depth, 2);
  QCOMPARE(QString::fromStdString((inItem - 1)->tag), QStringLiteral("Item 1"));
  QCOMPARE(QString::fromStdString((inItem - 2)->tag), QStringLiteral("(0008,1140)"));
}

void TestSeriesFacts::everyAttributeIsListed_data() {
  QTest::addColumn<QString>("file");
  for (const char* name : {"dicom-geometry/mr-enh-siemens-xa10", "dicom-ts-cornerstone/CT1_J2KR",
                           "dicom-ts-cornerstone", "dicom-geometry/ct-tiny-23x38x3/image"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// There are as many lines at every depth as DCMTK reads.
void TestSeriesFacts::everyAttributeIsListed() {
  QFETCH(QString, file);
  const std::string path = dataPath(file.toStdString());
  NEED_DATA(path);
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && !study->volumes.empty());
  for (const Series& series : study->volumes) {
    const std::string& first = series.files.front();
    const auto lines = dicom::listAttributes(first);
    QVERIFY2(lines.ok(), first.c_str());
    DcmFileFormat read;
    QVERIFY(read.loadFile(first.c_str(), EXS_Unknown, EGL_noChange, 256).good());
    std::size_t root = 0;
    for (const auto& line : *lines) root += line.depth == 0;
    const unsigned long behindPixels = read.getDataset()->tagExists(DCM_DataSetTrailingPadding) ? 1 : 0;
    QCOMPARE(root, std::size_t(read.getMetaInfo()->card() + read.getDataset()->card() - behindPixels));
  }
}

void TestSeriesFacts::whatCannotBeListedIsSaid() {
  const DicomFolder folder;
  QVERIFY(!dicom::listAttributes(folder.path("none")).message().empty());
  writeAll(folder.path("text"), {'h', 'e', 'l', 'l', 'o'});
  QVERIFY(!dicom::listAttributes(folder.path("text")).ok());
}

VOLUMEN_TEST(TestSeriesFacts);
#include "tst_series_facts.moc"
