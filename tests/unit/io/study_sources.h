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

/// Adds columns of character sets, of names in bytes of them, and of the same names in UTF-8.
inline void addNames() {
  QTest::addColumn<QByteArray>("set");
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QString>("text");
  const auto row = [](const char* script, const char* set, const char* name, const char* text) {
    QTest::newRow(script) << QByteArray(set) << QByteArray(name) << QString::fromUtf8(text);
  };
  row("ASCII", "", "Doe^Jane", "Doe^Jane");
  row("Latin-1", "ISO_IR 100",
      "Nu\xf1"
      "ez^Ren\xe9",
      "Nuñez^René");
  row("Central European", "ISO_IR 101", "Wa\xb3\xeasa^Lech", "Wałęsa^Lech");
  row("Turkish", "ISO_IR 148",
      "\xc7"
      "avu\xfeo\xf0lu^Ay\xfe"
      "e",
      "Çavuşoğlu^Ayşe");
  row("Cyrillic", "ISO_IR 144", "\xbb\xee\xda\xe1\xd5\xdc\xd1\xe3\xe0\xd3^\xc0\xde\xd7\xd0",
      "Люксембург^Роза");
  row("Greek", "ISO_IR 126", "\xc4\xe9\xef\xed\xf5\xf3\xe9\xef\xf2", "Διονυσιος");
  row("Arabic", "ISO_IR 127", "\xe2\xc8\xc7\xe6\xea^\xe4\xe6\xd2\xc7\xd1", "قباني^لنزار");
  row("Hebrew", "ISO_IR 138", "\xf9\xf8\xe5\xef^\xe3\xe1\xe5\xf8\xe4", "שרון^דבורה");
  row("Thai", "ISO_IR 166", "\xb9\xd2\xc1\xca\xa1\xd8\xc5^\xaa\xd7\xe8\xcd", "นามสกุล^ชื่อ");
  row("Japanese", "\\ISO 2022 IR 87", "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B",
      "Yamada^Tarou=山田^太郎");
  row("Japanese, half-width", "ISO 2022 IR 13\\ISO 2022 IR 87",
      "\xd4\xcf\xc0\xde^\xc0\xdb\xb3=\x1b$B;3ED\x1b(J^\x1b$BB@O:\x1b(J", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎");
  row("Korean", "\\ISO 2022 IR 149", "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7",
      "Hong^Gildong=洪^吉洞");
  row("Chinese, GB2312", "\\ISO 2022 IR 58", "Zhang^XiaoDong=\x1b$)A\xd5\xc5^\x1b$)A\xd0\xa1\xb6\xab",
      "Zhang^XiaoDong=张^小东");
  row("Chinese, GB18030", "GB18030", "Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab", "Wang^XiaoDong=王^小东");
  row("UTF-8", "ISO_IR 192", "Nuñez^José=王^小東", "Nuñez^José=王^小東");
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
