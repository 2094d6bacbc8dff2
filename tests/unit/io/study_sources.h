#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <sys/mount.h>

#include <QDir>
#include <QTest>
#include <string>
#include <vector>

#include "io/open.h"
#include "io/study/frame_series.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/mount_disk.h"
#include "tests/unit/io/dicom_folder.h"

namespace volumen::tests {

/// Adds a column of real series that objects are written for, with a row for each.
inline void addRealSources() {
  QTest::addColumn<QString>("source");
  const std::pair<const char*, const char*> sources[] = {
      {"CT", "ct-chest-lidc0314-138"},
      {"MR oblique", "mr-head-ge-mprage-130"},
      {"CT tilted", "dicom-geometry/ct-ge-tilt-varspacing-28"},
      {"PET", "pet-ct/sts019-pet"},
      {"US", "dicom-2d/us-cine-aspect-regions.dcm"},
      {"MG", "dicom-2d/mg-sigmoid-voilut3.dcm"},
      {"MR enhanced", "dicom-geometry/mr-enh-siemens-xa10"}};
  for (const auto& [name, path] : sources) QTest::newRow(name) << QString::fromLatin1(path);
}

/// Returns the first volume below a path, or its pictures as frames; empty if there is none.
inline Series seriesAt(const std::string& path) {
  const auto study = openStudy(path);
  if (study && !study->volumes.empty()) return study->volumes[0];
  const std::vector<Series> frames = study ? frameSeries(*study) : std::vector<Series>();
  return frames.empty() ? Series() : frames[0];
}

/// Three slices of a study whose patient has this name, as bytes in this character set.
struct NamedSlices {
  DicomFolder folder;
  Series series;

  explicit NamedSlices(const std::string& characterSet = {}, const std::string& name = "Doe^Jane") {
    for (int n = 0; n < 3; ++n) {
      DicomPicture picture = sliceAt(2.0 * n, n);
      picture.columns = picture.rows = 8;
      picture.edit = [&](DcmDataset& data) {
        if (!characterSet.empty()) data.putAndInsertString(DCM_SpecificCharacterSet, characterSet.c_str());
        data.putAndInsertString(DCM_PatientName, name.c_str());
        data.putAndInsertString(DCM_PatientID, "P1");
        data.putAndInsertString(DCM_SeriesNumber, "7");
        data.putAndInsertString(DCM_StudyDescription, "Head");
        data.putAndInsertString(DCM_ReferringPhysicianName, name.c_str());
        data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7");
      };
      folder.add(numbered("s", n), picture);
    }
    series = seriesAt(folder.path());
  }
  std::string out() const { return folder.path("out.dcm"); }
};

/// Adds columns of character sets and of names in bytes of them.
inline void addNames() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("name");
  QTest::newRow("ASCII") << QByteArray() << QByteArray("Doe^Jane");
  QTest::newRow("Latin-1") << QByteArray("ISO_IR 100")
                           << QByteArray(
                                  "Nu\xf1"
                                  "ez^Ren\xe9");
  QTest::newRow("Japanese") << QByteArray("\\ISO 2022 IR 87")
                            << QByteArray("Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B");
  QTest::newRow("Korean") << QByteArray("\\ISO 2022 IR 149")
                          << QByteArray("Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7");
  QTest::newRow("UTF-8") << QByteArray("ISO_IR 192")
                         << QByteArray("Wang^XiaoDong=\xe7\x8e\x8b^\xe5\xb0\x8f\xe6\x9d\xb1");
}

/// A written object, read with DCMTK.
struct ReadObject {
  DcmFileFormat file;
  explicit ReadObject(const std::string& path) {
    if (file.loadFile(OFFilename(path.c_str())).good()) file.loadAllDataIntoMemory();
  }
  DcmDataset& data() { return *file.getDataset(); }
  /// Returns a value as its bytes are; empty if it is missing.
  std::string operator[](const DcmTagKey& tag) {
    OFString text;
    return data().findAndGetOFStringArray(tag, text).good() ? text.c_str() : "";
  }
  bool has(const DcmTagKey& tag) { return data().tagExists(tag); }
  /// Returns item n of a sequence, or null.
  DcmItem* item(const DcmTagKey& sequence, long n = 0) {
    DcmItem* found = nullptr;
    return data().findAndGetSequenceItem(sequence, found, n).good() ? found : nullptr;
  }
};

/// Returns the names of patient and study attributes that a written object does not have as its source does.
inline QStringList notAsInSource(const std::string& object, const std::string& source) {
  ReadObject written(object), read(source);
  QStringList wrong;
  for (const DcmTagKey& tag :
       {DCM_PatientName, DCM_PatientID, DCM_PatientBirthDate, DCM_PatientSex, DCM_PatientAge,
        DCM_PatientWeight, DCM_StudyInstanceUID, DCM_StudyID, DCM_StudyDate, DCM_StudyTime,
        DCM_AccessionNumber, DCM_StudyDescription, DCM_ReferringPhysicianName, DCM_SpecificCharacterSet})
    if (written[tag] != read[tag])
      wrong << QString::fromLatin1(DcmTag(tag).getTagName()) + QStringLiteral(": ") +
                   QString::fromStdString(written[tag]);
  return wrong;
}

/// Returns all files of a folder, hidden ones too.
inline QStringList allFilesIn(const std::string& folder) {
  return QDir(QString::fromStdString(folder)).entryList(QDir::Files | QDir::Hidden);
}

}  // namespace volumen::tests

/// Fails the test function if dciodvfy finds an error in a file that it does not find in its source; nothing
/// is checked without dciodvfy.
#define COMPARE_WITH_STANDARD(path, source)                                      \
  if (!QStandardPaths::findExecutable(QStringLiteral("dciodvfy")).isEmpty()) {   \
    const QStringList ofSource = dciodvfyErrors(QString::fromStdString(source)); \
    for (const QString& error : dciodvfyErrors(QString::fromStdString(path)))    \
      QVERIFY2(ofSource.contains(error), qPrintable(error));                     \
  }
