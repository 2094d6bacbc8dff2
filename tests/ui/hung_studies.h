#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <functional>

#include "io/export/dicom_series.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen::tests {

/// A mammogram. `rowsTo` is its Patient Orientation: the directions of rows and columns in the patient.
struct Breast {
  const char *side, *view, *rowsTo;
  int columns, rows;
};

/// The left CC has the wrong orientation. The MLOs are larger.
inline const Breast breasts[] = {{"L", "MLO", "A\\F", 90, 120},
                                 {"R", "CC", "P\\L", 60, 80},
                                 {"L", "CC", "P\\L", 60, 80},
                                 {"R", "MLO", "P\\F", 90, 120}};

/// One series for all mammograms, or a separate series for each.
enum class BreastSeries { ofAll, ofEach };

inline bool writeBreast(const Breast& b, int number, const QString& path, BreastSeries series,
                        int patient = 77) {
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  const auto text = [&](const DcmTagKey& tag, const QString& value) {
    d.putAndInsertString(tag, value.toLatin1().constData());
  };
  const QString study = QStringLiteral("1.2.3.%1").arg(patient);
  const QString uid = QStringLiteral("%1.%2").arg(study).arg(number);
  text(DCM_SOPClassUID, QStringLiteral("1.2.840.10008.5.1.4.1.1.1.2"));
  text(DCM_SOPInstanceUID, uid);
  text(DCM_StudyInstanceUID, study);
  text(DCM_SeriesInstanceUID,
       QStringLiteral("%1.0.%2").arg(study).arg(series == BreastSeries::ofEach ? number : 0));
  text(DCM_SeriesNumber, QString::number(series == BreastSeries::ofEach ? number : 1));
  text(DCM_Modality, QStringLiteral("MG"));
  text(DCM_PatientID, QString::number(patient));
  text(DCM_PatientName, QStringLiteral("Doe^Jane"));
  text(DCM_StudyDate, QStringLiteral("20260301"));
  text(DCM_BodyPartExamined, QStringLiteral("BREAST"));
  text(DCM_InstanceNumber, QString::number(number));
  text(DCM_ImageLaterality, QLatin1String(b.side));
  text(DCM_ViewPosition, QLatin1String(b.view));
  text(DCM_PatientOrientation, QLatin1String(b.rowsTo));
  text(DCM_ImagerPixelSpacing, QStringLiteral("0.1\\0.1"));
  text(DCM_PhotometricInterpretation, QStringLiteral("MONOCHROME2"));
  text(DCM_WindowCenter, QStringLiteral("400"));
  text(DCM_WindowWidth, QStringLiteral("800"));
  d.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  d.putAndInsertUint16(DCM_Rows, Uint16(b.rows));
  d.putAndInsertUint16(DCM_Columns, Uint16(b.columns));
  d.putAndInsertUint16(DCM_BitsAllocated, 16);
  d.putAndInsertUint16(DCM_BitsStored, 12);
  d.putAndInsertUint16(DCM_HighBit, 11);
  d.putAndInsertUint16(DCM_PixelRepresentation, 0);
  const std::vector<Uint16> pixels(std::size_t(b.columns * b.rows), 300);
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
  return file.saveFile(path.toLocal8Bit().constData(), EXS_LittleEndianExplicit).good();
}

/// Four mammograms in a folder.
struct Mammograms {
  QTemporaryDir folder;
  int patient = 77;
  /// If `isOfOneSize`, all are as large as the CCs, so that one series is one stack.
  bool write(BreastSeries series = BreastSeries::ofAll, bool isOfOneSize = false) const {
    for (int n = 0; n < 4; ++n) {
      Breast breast = breasts[n];
      if (isOfOneSize) breast.columns = 60, breast.rows = 80;
      if (!writeBreast(breast, n + 1, folder.filePath(QString::number(n)), series, patient)) return false;
    }
    return true;
  }
};

/// The same series of one patient on two dates.
struct TwoDays {
  QTemporaryDir folder;
  QString now = folder.filePath(QStringLiteral("now")), before = folder.filePath(QStringLiteral("before"));

  bool write() const { return writeDay(now, "20260301") && writeDay(before, "20240215"); }
  static bool writeDay(const QString& path, const char* day,
                       const std::function<void(DicomSeriesTags&)>& edit = {}) {
    DicomSeriesTags tags;
    tags.patientName = "Doe^Jane", tags.patientId = "77", tags.studyDate = day;
    tags.studyUid = std::string("1.2.3.") + day, tags.description = "Head";
    if (edit) edit(tags);
    const Result<VolumePtr> volume = makePhantom("ct-head:20");
    return volume && writeDicomSeries(**volume, tags, path.toStdString());
  }
};

}  // namespace volumen::tests
