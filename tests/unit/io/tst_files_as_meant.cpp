// Guards import.md: the meaning of single files whose attributes are missing, contradict the bytes or deviate
// from the standard's spelling. Assumptions are reported.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

#include "io/segmentation.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/io/made_segmentation.h"
#include "tests/unit/io/pet_series.h"
#include "tests/unit/io/series_summary.h"
#include "tests/unit/suite.h"
#include "viewer/slice/grey.h"

using namespace volumen;
using namespace volumen::tests;

/// Wraps an Edit in a type that only this file registers with Qt.
struct FileEdit {
  Edit run;
};
Q_DECLARE_METATYPE(FileEdit)

class TestFilesAsMeant : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void missingAttributesAreTold_data();
  void missingAttributesAreTold();
  void bitsThatNothingTellsAreRefused_data();
  void bitsThatNothingTellsAreRefused();
  void tablesHaveTheBitsOfTheirData_data();
  void tablesHaveTheBitsOfTheirData();
  void textsAreReadAsTheirBytesAre_data();
  void textsAreReadAsTheirBytesAre();
  void labelsOfSegmentsAreTold();
  void windowFunctionsInOtherSpellings_data();
  void windowFunctionsInOtherSpellings();
  void termsInOtherSpellings_data();
  void termsInOtherSpellings();
};

namespace {

constexpr const char* nothing = "";

bool hasWarning(const Study& study, const QByteArray& words) {
  return !study.volumes.empty() && warns(study.volumes[0].warnings, words.toStdString());
}

}  // namespace

void TestFilesAsMeant::missingAttributesAreTold_data() {
  QTest::addColumn<FileEdit>("edit");
  QTest::addColumn<double>("value");  // real value of stored 0xfc18
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, double value, const char* says, const Edit& edit) {
    QTest::newRow(name) << FileEdit{edit} << value << QByteArray(says);
  };
  const auto without = [](std::initializer_list<DcmTagKey> tags, const char* modality = "CT") {
    return Edit([tags = std::vector<DcmTagKey>(tags), modality](DcmDataset& d) {
      for (const DcmTagKey& tag : tags) d.findAndDeleteElement(tag);
      d.putAndInsertString(DCM_Modality, modality);
    });
  };
  const auto bits = [&](std::initializer_list<DcmTagKey> tags) {
    return Edit([edit = without(tags)](DcmDataset& d) {
      d.putAndInsertUint16(DCM_BitsStored, 12);
      d.putAndInsertUint16(DCM_HighBit, 11);
      edit(d);
    });
  };
  row("nothing", 64536, nothing, without({}));
  row("the sign of a CT", -1000, "read as signed, for a CT", without({DCM_PixelRepresentation}));
  row("the sign of an MR", 64536, "read as unsigned, which is a guess",
      without({DCM_PixelRepresentation}, "MR"));
  row("the sign of a CT whose intercept leaves it room", 64536 - 32768, "read as unsigned",
      [](DcmDataset& d) {
        d.findAndDeleteElement(DCM_PixelRepresentation);
        d.putAndInsertString(DCM_RescaleSlope, "1");
        d.putAndInsertString(DCM_RescaleIntercept, "-32768");
      });
  row("the sign, with signed padding", -1000, "read as signed, as its PixelPaddingValue is",
      [](DcmDataset& d) {
        d.findAndDeleteElement(DCM_PixelRepresentation);
        d.putAndInsertString(DCM_Modality, "MR");
        d.putAndInsertSint16(DcmTag(DCM_PixelPaddingValue, EVR_SS), -2000);
      });
  row("the sign, with an unsigned smallest value", 64536, "read as unsigned, as its Smallest",
      [](DcmDataset& d) {
        d.findAndDeleteElement(DCM_PixelRepresentation);
        d.putAndInsertUint16(DcmTag(DCM_SmallestImagePixelValue, EVR_US), 0);
      });
  row("the sign of an MR, whose bits above are ones", -1000, "read as signed, as the bits above",
      [](DcmDataset& d) {
        d.putAndInsertUint16(DCM_BitsStored, 12);
        d.putAndInsertUint16(DCM_HighBit, 11);
        d.findAndDeleteElement(DCM_PixelRepresentation);
        d.putAndInsertString(DCM_Modality, "MR");
      });
  row("the bits stored, by the high bit", 0xc18, "BitsStored is missing: the lower 12",
      bits({DCM_BitsStored}));
  row("the bits stored and the high bit", 64536, "BitsStored is missing: the lower 16",
      bits({DCM_BitsStored, DCM_HighBit}));
  row("the high bit, of fewer bits", 0xc18, "HighBit is missing: the lower 12", bits({DCM_HighBit}));
  row("the high bit, of all bits", 64536, nothing, without({DCM_HighBit}));
  row("the samples of a pixel", 64536, "SamplesPerPixel is missing: 1 is taken",
      without({DCM_SamplesPerPixel}));
  row("the kind of grey", 64536, "PhotometricInterpretation is missing",
      without({DCM_PhotometricInterpretation}));
  row("the bits allocated, by the length of the pixels", 64536, "BitsAllocated is missing: 16 is taken, as",
      without({DCM_BitsAllocated}));
  row("all bits, by the length of the pixels", 64536, "BitsAllocated is missing: 16 is taken",
      without({DCM_BitsAllocated, DCM_BitsStored, DCM_HighBit}));
  row("the bits allocated of bytes", 0x18, "BitsAllocated is missing: 8 is taken", [](DcmDataset& d) {
    d.findAndDeleteElement(DCM_BitsAllocated);
    d.putAndInsertUint16(DCM_BitsStored, 8);
    d.putAndInsertUint16(DCM_HighBit, 7);
    const std::vector<Uint8> bytes(12, 0x18);
    d.findAndDeleteElement(DCM_PixelData);
    d.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size());
  });
  row("the intercept", 2 * 64536, "RescaleIntercept is missing: 0 is taken",
      [](DcmDataset& d) { d.putAndInsertString(DCM_RescaleSlope, "2"); });
  row("the slope", 64536 - 24, "RescaleSlope is missing: 1 is taken",
      [](DcmDataset& d) { d.putAndInsertString(DCM_RescaleIntercept, "-24"); });
  row("no frames, of the bytes of one", 64536, "NumberOfFrames is 0: its pixel data is read as 1 frame",
      [](DcmDataset& d) { d.putAndInsertString(DCM_NumberOfFrames, "0"); });
}

void TestFilesAsMeant::missingAttributesAreTold() {
  QFETCH(FileEdit, edit);
  QFETCH(double, value);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  DicomPicture picture = sliceAt(0, 0xfc18);
  picture.edit = edit.run;
  folder.add("a", picture);
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, study.refused.empty() ? "" : study.refused[0].reason.c_str());
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(double(loaded->acquired->valueAt(0)), value);
  for (const Warning& warning : study.volumes[0].warnings)
    QVERIFY2(!says.isEmpty() || warning.sentence.find("is missing") == std::string::npos,
             warning.sentence.c_str());
  if (!says.isEmpty()) QVERIFY(hasWarning(study, says));
}

void TestFilesAsMeant::bitsThatNothingTellsAreRefused_data() {
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("bitsStored");  // 0: missing
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<QByteArray>("says");
  const QByteArray native("1.2.840.10008.1.2.1"), rle("1.2.840.10008.1.2.5");
  QTest::newRow("two bytes of one pixel")
      << 1 << 0 << native << QByteArray("the 2 bytes of its pixel data do not");
  QTest::newRow("more bits stored than there are") << 4 << 20 << native << QByteArray("the 8 bytes of its");
  QTest::newRow("compressed, without bits stored")
      << 4 << 0 << rle << QByteArray("its compressed pixels do not");
  QTest::newRow("compressed, with bits stored") << 4 << 12 << rle << QByteArray();
}

void TestFilesAsMeant::bitsThatNothingTellsAreRefused() {
  QFETCH(int, columns);
  QFETCH(int, bitsStored);
  QFETCH(QByteArray, syntax);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  DicomPicture picture;
  picture.columns = columns, picture.rows = 1;
  folder.add("whole", picture, syntax.constData());
  DcmFileFormat file;
  QVERIFY(file.loadFile(folder.path("whole").c_str()).good());
  QFile::remove(QString::fromStdString(folder.path("whole")));
  for (const DcmTagKey& tag : {DCM_BitsAllocated, DCM_BitsStored, DCM_HighBit})
    file.getDataset()->findAndDeleteElement(tag);
  if (bitsStored > 0) file.getDataset()->putAndInsertUint16(DCM_BitsStored, Uint16(bitsStored));
  const E_TransferSyntax kept = DcmXfer(syntax.constData()).getXfer();
  QVERIFY(file.saveFile(folder.path("a").c_str(), kept).good());
  const Study study = folder.open();
  if (says.isEmpty()) {
    QVERIFY(hasWarning(study, "BitsAllocated is missing: 16 is taken, as its BitsStored is 12"));
    QVERIFY(loadSeries(study.volumes[0]).ok());
    return;
  }
  QCOMPARE(study.refused.size(), std::size_t(1));
  const QByteArray reason = QByteArray::fromStdString(study.refused[0].reason);
  QVERIFY2(reason.contains("BitsAllocated") && reason.contains(says), reason);
}

void TestFilesAsMeant::tablesHaveTheBitsOfTheirData_data() {
  QTest::addColumn<bool>("palette");  // else a VOI LUT
  QTest::addColumn<QList<int>>("descriptor");
  QTest::addColumn<QList<int>>("words");
  QTest::addColumn<bool>("inSegments");
  QTest::addColumn<QList<int>>("shown");  // bytes of the four entries
  const auto row = [](const char* name, bool palette, QList<int> descriptor, QList<int> words,
                      QList<int> shown, bool inSegments = false) {
    QTest::newRow(name) << palette << descriptor << words << inSegments << shown;
  };
  row("a palette that says 8 bits and has 16", true, {4, 0, 8}, {0x1100, 0x2200, 0x8000, 0xff00},
      {0x11, 0x22, 0x80, 0xff});
  row("a palette that says 16 bits and has 8", true, {4, 0, 16}, {0x1401, 0xff1e}, {1, 20, 30, 255});
  row("in segments, says 8 and has 16", true, {4, 0, 8}, {0, 4, 0x1100, 0x2200, 0x8000, 0xff00},
      {0x11, 0x22, 0x80, 0xff}, true);
  row("in segments, says 16 and has 8", true, {4, 0, 16}, {0x0400, 0x1401, 0xff1e}, {1, 20, 30, 255}, true);
  row("a VOI LUT that says 16 bits and has 8", false, {4, 0, 16}, {0x1401, 0xff1e}, {1, 20, 30, 255});
}

void TestFilesAsMeant::tablesHaveTheBitsOfTheirData() {
  QFETCH(bool, palette);
  QFETCH(QList<int>, descriptor);
  QFETCH(QList<int>, words);
  QFETCH(bool, inSegments);
  QFETCH(QList<int>, shown);
  const std::vector<Uint16> said(descriptor.begin(), descriptor.end()), entries(words.begin(), words.end());
  const auto putTable = [&](DcmItem& item, const DcmTagKey& of, const DcmTagKey& data) {
    item.putAndInsertUint16Array(DcmTag(of, EVR_US), said.data(), said.size());
    item.putAndInsertUint16Array(DcmTag(data, EVR_OW), entries.data(), entries.size());
  };
  const DicomFolder folder;
  DicomPicture picture;
  picture.columns = 4, picture.rows = 1;
  picture.pixels = {0, 1, 2, 3};
  picture.edit = [&](DcmDataset& d) {
    DcmItem* lut = nullptr;
    if (palette) d.putAndInsertString(DCM_PhotometricInterpretation, "PALETTE COLOR");
    if (!palette) d.findOrCreateSequenceItem(DCM_VOILUTSequence, lut);
    if (lut) return putTable(*lut, DCM_LUTDescriptor, DCM_LUTData);
    for (Uint16 colour = 0; colour < 3; ++colour)
      putTable(d, {0x0028, Uint16(0x1101 + colour)},
               {0x0028, Uint16((inSegments ? 0x1221 : 0x1201) + colour)});
  };
  folder.add("a", picture);
  const auto frame = frameOf(folder.path("a"));
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  for (int n = 0; n < 4; ++n)
    QCOMPARE(palette ? int(frame->rgb[std::size_t(3 * n)])
                     : int(greyBytes(frame->values.floats(), frame->greys.at(0).mapping)[std::size_t(n)]),
             shown[n]);
  QCOMPARE(std::ranges::count_if(
               frame->warnings, [](const std::string& w) { return w.find("look-up tables says") != w.npos; }),
           1);
}

void TestFilesAsMeant::textsAreReadAsTheirBytesAre_data() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* set, const char* bytes, const char* text,
                      const char* says) {
    QTest::newRow(name) << QByteArray(set) << QByteArray(bytes) << QString::fromUtf8(text)
                        << QByteArray(says);
  };
  const char* const guess = "read as ISO_IR 100, which is a guess";
  row("Latin-1 where UTF-8 is declared", "ISO_IR 192", "M\xfcller^Jos\xe9", "Müller^José", guess);
  row("Latin-1 where nothing is declared", "", "M\xfcller^Jos\xe9", "Müller^José", guess);
  row("Latin-1 where an unknown set is declared", "KLINGON", "M\xfcller", "Müller", guess);
  row("UTF-8 where Latin-1 is declared", "ISO_IR 100", "M\xc3\xbcller", "Müller", "read as UTF-8");
  row("UTF-8 where Cyrillic is declared", "ISO_IR 144", "\xd0\x9f\xd1\x91\xd1\x82\xd1\x80", "Пётр",
      "read as UTF-8");
  row("UTF-8 where katakana is declared", "ISO_IR 13", "\xe3\x83\x86\xe3\x82\xb9", "テス", "read as UTF-8");
  row("accents of their own over ASCII letters", "ISO_IR 100", "Mu\xcc\x88ller", "Mu\xcc\x88ller",
      "read as UTF-8");
  row("two Czech letters that are UTF-8 by chance", "ISO_IR 101",
      "\xda\xbe"
      "as",
      "Úžas", nothing);
  row("two Cyrillic letters that are UTF-8 by chance", "ISO_IR 144", "\xc2\xb0", "ТА", nothing);
  row("katakana that is UTF-8 by chance", "ISO_IR 13", "\xc3\xbd", "ﾃｽ", nothing);
  row("UTF-8 that is cut off within a letter", "ISO_IR 192", "\xd0\x9f\xd1\x91\xd1", "Пё\xef\xbf\xbd",
      "damaged or none of its character set");
  row("a byte that Greek does not have", "ISO_IR 126", "\xc1\xd2\xc1", "Α\xef\xbf\xbdΑ",
      "damaged or none of its character set");
}

void TestFilesAsMeant::textsAreReadAsTheirBytesAre() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, bytes);
  QFETCH(QString, name);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  for (int n = 0; n < 2; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = [&](DcmDataset& d) {
      if (!set.isEmpty()) d.putAndInsertString(DCM_SpecificCharacterSet, set.constData());
      d.putAndInsertString(DCM_PatientName, bytes.constData());
      d.putAndInsertString(DCM_SeriesDescription, bytes.constData());
    };
    folder.add(numbered("s", n), picture);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(study.volumes[0].patientName), name);
  QCOMPARE(QString::fromStdString(study.volumes[0].description), name);
  QCOMPARE(study.volumes[0].warnings.size(), std::size_t(says.isEmpty() ? 0 : 1));
  if (!says.isEmpty()) QVERIFY2(hasWarning(study, says), study.volumes[0].warnings[0].sentence.c_str());
}

void TestFilesAsMeant::labelsOfSegmentsAreTold() {
  const DicomFolder folder;
  MadeSegmentation made;
  made.edit = [](DcmItem& d) {
    DcmItem* segment = nullptr;
    d.findOrCreateSequenceItem(DCM_SegmentSequence, segment);
    segment->putAndInsertString(DCM_SegmentLabel, "L\xe4sion");
  };
  writeSegmentation(folder.path("seg"), made);
  const auto read = loadSegmentation(folder.path("seg"));
  QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
  QCOMPARE(QString::fromStdString(read->segments.at(0).label), QString::fromUtf8("Läsion"));
  QCOMPARE(read->notes.size(), std::size_t(1));
  QVERIFY2(read->notes[0].find("which is a guess.") != std::string::npos, read->notes[0].c_str());
}

void TestFilesAsMeant::windowFunctionsInOtherSpellings_data() {
  QTest::addColumn<QByteArray>("term");
  QTest::addColumn<int>("function");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* term, WindowFunction function, const char* says) {
    QTest::newRow(term) << QByteArray(term) << int(function) << QByteArray(says);
  };
  row("SIGMOID", WindowFunction::sigmoid, nothing);
  row("LINEAR_EXACT", WindowFunction::linearExact, nothing);
  row("sigmoid", WindowFunction::sigmoid, "read as SIGMOID");
  row("Linear", WindowFunction::linear, "read as LINEAR.");
  row("LINEAR EXACT", WindowFunction::linearExact, "read as LINEAR_EXACT");
  row("linear-exact", WindowFunction::linearExact, "read as LINEAR_EXACT");
  row("GAMMA", WindowFunction::linear, "is not known: it was read as LINEAR");
}

void TestFilesAsMeant::windowFunctionsInOtherSpellings() {
  QFETCH(QByteArray, term);
  QFETCH(int, function);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  for (int n = 0; n < 2; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = [&](DcmDataset& d) {
      d.putAndInsertString(DCM_WindowCenter, "40");
      d.putAndInsertString(DCM_WindowWidth, "400");
      d.putAndInsertString(DCM_VOILUTFunction, term.constData());
    };
    folder.add(numbered("s", n), picture);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].warnings.size(), std::size_t(says.isEmpty() ? 0 : 1));
  if (!says.isEmpty()) QVERIFY2(hasWarning(study, says), study.volumes[0].warnings[0].sentence.c_str());
  const auto frame = loadFrame(study.volumes[0], 0);
  QVERIFY(frame.ok());
  QCOMPARE(int(frame->greys.at(0).mapping.function), function);
  QVERIFY(frame->warnings.empty());  // the series reports it
}

void TestFilesAsMeant::termsInOtherSpellings_data() {
  QTest::addColumn<QByteArray>("modality");
  QTest::addColumn<uint>("tag");
  QTest::addColumn<QByteArray>("spelling");
  QTest::addColumn<QByteArray>("term");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* modality, uint tag, const char* spelling, const char* term,
                      const char* unit) {
    QTest::newRow(spelling) << QByteArray(modality) << tag << QByteArray(spelling) << QByteArray(term)
                            << QString::fromLatin1(unit);
  };
  row("CT", 0x00280004, "monochrome2", "MONOCHROME2", "HU");
  row("CT", 0x00280004, "MONOCHROME_1", "MONOCHROME1", "HU");
  row("MR", 0x00281054, "hu", "HU", "HU");
  row("PT", 0x00541001, "Bq/ml", "BQML", "Bq/ml");
  row("PT", 0x00541001, "g/ml", "GML", "SUV");
}

void TestFilesAsMeant::termsInOtherSpellings() {
  QFETCH(QByteArray, modality);
  QFETCH(uint, tag);
  QFETCH(QByteArray, spelling);
  QFETCH(QByteArray, term);
  QFETCH(QString, unit);
  const DicomFolder folder;
  for (int n = 0; n < 2; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = [&](DcmDataset& d) {
      d.putAndInsertString(DCM_Modality, modality.constData());
      d.putAndInsertString(DcmTagKey(Uint16(tag >> 16), Uint16(tag & 0xffff)), spelling.constData());
    };
    folder.add(numbered("s", n), picture);
  }
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, study.refused.empty() ? "" : study.refused[0].reason.c_str());
  QCOMPARE(QString::fromStdString(study.volumes[0].unit), unit);
  QVERIFY(hasWarning(study, "\"" + spelling + "\" is no term of the standard: it was read as " + term));
  QVERIFY(loadSeries(study.volumes[0]).ok());
}

VOLUMEN_TEST(TestFilesAsMeant);
#include "tst_files_as_meant.moc"
