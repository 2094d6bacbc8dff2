// Guards import.md, "Write a volume as DICOM", through the command line. A copy keeps patient, position and
// acquisition of its source. Derived data are marked, and values stay the same.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <cmath>
#include <map>
#include <set>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestConvertDicom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatTheSourceSaysStays_data() { series(); }
  void whatTheSourceSaysStays();
  void valuesStay_data() { series(); }
  void valuesStay();
  void isValid_data() { series(); }
  void isValid();
  void enhancedPicturesKeepWhatTheirFramesSay();
  void interpolatedSlicesSaySo();
  void roundedValuesAreTold();
  void dosesAreRefused();

 private:
  static void series();
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  /// Returns the copy of a series of real data, made once. Empty if that failed.
  QString copyOf(const QString& name);
  QTemporaryDir folder_;
  std::map<QString, QString> copies_;
};

namespace {

QStringList filesIn(const QString& folder) {
  QStringList files;
  for (const QString& name : QDir(folder).entryList(QDir::Files, QDir::Name))
    files << QDir(folder).filePath(name);
  return files;
}

std::string textOf(DcmItem& item, const DcmTagKey& tag) {
  OFString text;
  item.findAndGetOFStringArray(tag, text, OFTrue);
  return std::string(text.c_str(), text.size());
}

// Compares values of elements. Numbers may be written differently.
bool sayTheSame(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const QStringList left = QString::fromStdString(a).split(QLatin1Char('\\')),
                    right = QString::fromStdString(b).split(QLatin1Char('\\'));
  if (left.size() != right.size()) return false;
  for (int n = 0; n < left.size(); ++n) {
    bool isLeft = false, isRight = false;
    const double x = left[n].toDouble(&isLeft), y = right[n].toDouble(&isRight);
    if (left[n].trimmed() != right[n].trimmed() && !(isLeft && isRight && x == y)) return false;
  }
  return true;
}

std::map<std::string, QString> byInstance(const QString& folder) {
  std::map<std::string, QString> files;
  for (const QString& path : filesIn(folder)) {
    DcmFileFormat file;
    if (file.loadFile(OFFilename(path.toUtf8().constData())).good())
      files[textOf(*file.getDataset(), DCM_SOPInstanceUID)] = path;
  }
  return files;
}

std::set<std::string> framesOf(const std::map<std::string, QString>& files) {
  std::set<std::string> frames;
  for (const auto& [uid, path] : files) {
    DcmFileFormat file;
    if (!file.loadFile(OFFilename(path.toUtf8().constData())).good()) continue;
    if (const std::string frame = textOf(*file.getDataset(), DCM_FrameOfReferenceUID); !frame.empty())
      frames.insert(frame);
  }
  return frames;
}

std::string sourceOf(DcmItem& copy) {
  DcmItem* item = nullptr;
  copy.findAndGetSequenceItem(DCM_SourceImageSequence, item);
  return item ? textOf(*item, DCM_ReferencedSOPInstanceUID) : std::string();
}

// Copies a folder without some of its files.
void copyWithout(const QString& from, const QString& to, const std::set<int>& left) {
  QVERIFY(QDir().mkpath(to));
  const QStringList files = filesIn(from);
  for (int n = 0; n < files.size(); ++n)
    if (!left.contains(n)) QVERIFY(QFile::copy(files[n], QDir(to).filePath(QFileInfo(files[n]).fileName())));
}

}  // namespace

void TestConvertDicom::series() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"ct-chest-lidc0314-138", "mr-head-ge-mprage-130", "mr-head-siemens-gap-175",
                           "pet-ct/sts019-pet", "dicom-geometry/ct-head-slicer-93"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

QString TestConvertDicom::copyOf(const QString& name) {
  if (const auto it = copies_.find(name); it != copies_.end()) return it->second;
  const QString to = folder_.filePath(QStringLiteral("copy%1").arg(copies_.size()));
  const QString from = QString::fromStdString(dataPath(name.toStdString()));
  const Outcome a =
      runProgram({QStringLiteral("convert"), from, QStringLiteral("-o"), to + QLatin1Char('/')});
  if (a.status != 0) qWarning("%s", a.err.constData());
  return copies_[name] = a.status == 0 ? to : QString();
}

void TestConvertDicom::whatTheSourceSaysStays() {
  QFETCH(QString, name);
  const std::string from = dataPath(name.toStdString());
  NEED_DATA(from);
  const std::map<std::string, QString> sources = byInstance(QString::fromStdString(from));
  const std::set<std::string> frames = framesOf(sources);
  const QStringList copies = filesIn(copyOf(name));
  QVERIFY(!copies.isEmpty());
  for (const int n : {0, int(copies.size()) / 2, int(copies.size()) - 1}) {
    DcmFileFormat copyFile, sourceFile;
    QVERIFY(copyFile.loadFile(OFFilename(copies[n].toUtf8().constData())).good());
    DcmDataset& copy = *copyFile.getDataset();
    const std::string uid = sourceOf(copy);
    QVERIFY2(sources.contains(uid), uid.c_str());
    QVERIFY(sourceFile.loadFile(OFFilename(sources.at(uid).toUtf8().constData())).good());
    DcmDataset& source = *sourceFile.getDataset();
    for (const DcmTagKey& tag : {DCM_PatientName,
                                 DCM_PatientID,
                                 DCM_PatientBirthDate,
                                 DCM_PatientSex,
                                 DCM_PatientAge,
                                 DCM_PatientWeight,
                                 DCM_PatientSize,
                                 DCM_StudyInstanceUID,
                                 DCM_StudyDate,
                                 DCM_StudyTime,
                                 DCM_StudyID,
                                 DCM_AccessionNumber,
                                 DCM_StudyDescription,
                                 DCM_ReferringPhysicianName,
                                 DCM_SeriesDate,
                                 DCM_SeriesTime,
                                 DCM_SeriesNumber,
                                 DCM_SeriesDescription,
                                 DCM_Modality,
                                 DCM_SOPClassUID,
                                 DCM_PatientPosition,
                                 DCM_BodyPartExamined,
                                 DCM_Manufacturer,
                                 DCM_ManufacturerModelName,
                                 DCM_SliceThickness,
                                 DCM_AcquisitionDate,
                                 DCM_AcquisitionTime,
                                 DCM_KVP,
                                 DCM_ConvolutionKernel,
                                 DCM_XRayTubeCurrent,
                                 DCM_RepetitionTime,
                                 DCM_EchoTime,
                                 DCM_InversionTime,
                                 DCM_FlipAngle,
                                 DCM_ScanningSequence,
                                 DCM_SequenceVariant,
                                 DCM_MagneticFieldStrength,
                                 DCM_WindowCenter,
                                 DCM_WindowWidth,
                                 DCM_RescaleSlope,
                                 DCM_RescaleIntercept,
                                 DCM_Units,
                                 DCM_DecayCorrection,
                                 DCM_CorrectedImage,
                                 DCM_Radiopharmaceutical,
                                 DCM_RadionuclideTotalDose,
                                 DCM_RadionuclideHalfLife,
                                 DCM_RadiopharmaceuticalStartTime,
                                 DCM_FrameReferenceTime,
                                 DCM_ActualFrameDuration,
                                 DCM_DecayFactor}) {
      const std::string was = textOf(source, tag), is = textOf(copy, tag);
      QVERIFY2(was.empty() || sayTheSame(was, is),
               (DcmTag(tag).getTagName() + std::string(": ") + was + " became " + is).c_str());
    }
    QVERIFY(textOf(copy, DCM_SOPInstanceUID) != uid);
    QVERIFY(textOf(copy, DCM_SeriesInstanceUID) != textOf(source, DCM_SeriesInstanceUID));
    QVERIFY(QString::fromStdString(textOf(copy, DCM_ImageType)).startsWith(QLatin1String("DERIVED\\")));
    QVERIFY(textOf(copy, DCM_DerivationDescription).find("volumen") != std::string::npos);
  }
}

void TestConvertDicom::valuesStay() {
  QFETCH(QString, name);
  const std::string from = dataPath(name.toStdString());
  NEED_DATA(from);
  const std::string to = copyOf(name).toStdString();
  QVERIFY(!to.empty());
  const auto was = openStudy(from), is = openStudy(to);
  QVERIFY(was && is);
  QCOMPARE(is->volumes.size(), std::size_t(1));
  const auto before = loadSeries(was->volumes[*chooseSeries(*was, {})]), after = loadSeries(is->volumes[0]);
  QVERIFY(before && after);
  const Volume &a = *before->drawn, &b = *after->drawn;
  QVERIFY(a.size() == b.size());
  const std::size_t voxels = std::size_t(a.geometry().voxelCount());
  for (std::size_t n = 0; n < voxels; ++n)
    if (a.valueAt(n) != b.valueAt(n)) QCOMPARE(b.valueAt(n), a.valueAt(n));
  QCOMPARE(is->volumes[0].unit, was->volumes[0].unit);
}

// dciodvfy finds no problem that the source does not have.
void TestConvertDicom::isValid() {
  QFETCH(QString, name);
  NEED_DATA(dataPath(name.toStdString()));
  NEED_DCIODVFY();
  const QStringList copies = filesIn(copyOf(name));
  QVERIFY(!copies.isEmpty());
  const std::map<std::string, QString> sources =
      byInstance(QString::fromStdString(dataPath(name.toStdString())));
  const QString& copy = copies[copies.size() / 2];
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(copy.toUtf8().constData())).good());
  const QStringList before = dciodvfyErrors(sources.at(sourceOf(*file.getDataset())));
  for (const QString& error : dciodvfyErrors(copy)) QVERIFY2(before.contains(error), qPrintable(error));
}

void TestConvertDicom::enhancedPicturesKeepWhatTheirFramesSay() {
  const std::string from = dataPath("dicom-geometry/mr-enh-siemens-xa10");
  NEED_DATA(from);
  const QString to = at("enhanced");
  const Outcome a =
      runProgram({QStringLiteral("convert"), QString::fromStdString(from), QStringLiteral("--series"),
                  QStringLiteral("1"), QStringLiteral("-o"), to + QLatin1Char('/')});
  QVERIFY2(a.status == 0, a.err);
  DcmFileFormat file;
  QVERIFY(file.loadFile(OFFilename(filesIn(to)[0].toUtf8().constData())).good());
  DcmDataset& copy = *file.getDataset();
  QCOMPARE(textOf(copy, DCM_SOPClassUID), std::string(UID_MRImageStorage));
  for (const DcmTagKey& tag : {DCM_RepetitionTime, DCM_EchoTime, DCM_FlipAngle, DCM_MagneticFieldStrength,
                               DCM_SliceThickness, DCM_WindowCenter, DCM_PatientPosition}) {
    const std::string text = textOf(copy, tag);
    QVERIFY2(!text.empty() && text.size() <= 16, DcmTag(tag).getTagName());
  }
  DcmItem* item = nullptr;
  QVERIFY(copy.findAndGetSequenceItem(DCM_SourceImageSequence, item).good());
  QVERIFY(!textOf(*item, DCM_ReferencedFrameNumber).empty());
}

// One of 93 slices is missing. The copy has 93, of which the interpolated one is marked as such. stderr gives
// no second count.
void TestConvertDicom::interpolatedSlicesSaySo() {
  const std::string from = dataPath("dicom-geometry/ct-head-slicer-93");
  NEED_DATA(from);
  const auto study = openStudy(from);
  QVERIFY(study && !study->volumes.empty());
  const QString missing = at("missing"), to = at("filled");
  const QString left = QFileInfo(QString::fromStdString(study->volumes[0].files[40])).fileName();
  const QStringList all = filesIn(QString::fromStdString(from));
  int at = 0;
  while (at < all.size() && QFileInfo(all[at]).fileName() != left) ++at;
  copyWithout(QString::fromStdString(from), missing, {at});
  const Outcome a =
      runProgram({QStringLiteral("convert"), missing, QStringLiteral("-o"), to + QLatin1Char('/')});
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("93 evenly spaced slices were written, 1 of them interpolated."), a.err);
  QVERIFY2(!a.err.contains("0 of them"), a.err);
  int interpolated = 0;
  for (const QString& path : filesIn(to)) {
    DcmFileFormat file;
    QVERIFY(file.loadFile(OFFilename(path.toUtf8().constData())).good());
    const std::string words = textOf(*file.getDataset(), DCM_DerivationDescription);
    if (words.find("Interpolated between") == std::string::npos) continue;
    ++interpolated;
    DcmItem *first = nullptr, *second = nullptr;
    QVERIFY(file.getDataset()->findAndGetSequenceItem(DCM_SourceImageSequence, first, 0).good());
    QVERIFY(file.getDataset()->findAndGetSequenceItem(DCM_SourceImageSequence, second, 1).good());
    QVERIFY(textOf(*first, DCM_ReferencedSOPInstanceUID) != textOf(*second, DCM_ReferencedSOPInstanceUID));
  }
  QCOMPARE(interpolated, 1);
}

// Each slice of a PET has its own rescale. An interpolated slice has none, so its values are rounded.
void TestConvertDicom::roundedValuesAreTold() {
  const std::string from = dataPath("pet-ct/sts019-pet");
  NEED_DATA(from);
  const auto study = openStudy(from);
  QVERIFY(study && !study->volumes.empty());
  const QString missing = at("pet-missing"), to = at("pet-filled");
  const QStringList all = filesIn(QString::fromStdString(from));
  const QString left = QFileInfo(QString::fromStdString(study->volumes[0].files[20])).fileName();
  int at = 0;
  while (at < all.size() && QFileInfo(all[at]).fileName() != left) ++at;
  copyWithout(QString::fromStdString(from), missing, {at});
  const Outcome a =
      runProgram({QStringLiteral("convert"), missing, QStringLiteral("-o"), to + QLatin1Char('/')});
  QVERIFY2(a.status == 0, a.err);
  const QRegularExpression told(
      QStringLiteral("Values were rounded to 16 bits a slice: at most ([0-9.e-]+) off"));
  const QRegularExpressionMatch match = told.match(QString::fromUtf8(a.err));
  QVERIFY2(match.hasMatch(), a.err);
  const double most = match.captured(1).toDouble();
  const auto was = openStudy(missing.toStdString()), is = openStudy(to.toStdString());
  QVERIFY(was && is && is->volumes.size() == 1);
  const auto before = loadSeries(was->volumes[0]), after = loadSeries(is->volumes[0]);
  QVERIFY(before && after && before->drawn->size() == after->drawn->size());
  double largest = 0;
  for (std::size_t n = 0; n < std::size_t(before->drawn->geometry().voxelCount()); ++n)
    largest =
        std::max(largest, std::abs(double(before->drawn->valueAt(n)) - double(after->drawn->valueAt(n))));
  QVERIFY(largest > 0);
  QVERIFY2(largest <= most * 1.01, qPrintable(QString::number(largest)));
}

void TestConvertDicom::dosesAreRefused() {
  const std::string from = dataPath("field-cases/c06-dose-absolute-offsets");
  NEED_DATA(from);
  const Outcome a = runProgram(
      {QStringLiteral("convert"), QString::fromStdString(from), QStringLiteral("-o"), at("dose/")});
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("doses"), a.err);
}

VOLUMEN_TEST(TestConvertDicom);
#include "tst_convert_dicom.moc"
