#include "tests/unit/archive/archived_studies.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>

#include <QDirIterator>
#include <QJsonObject>

#include "io/dicom/decode.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

QString writeArchived(const QString& folder, const ArchivedStudy& m, int series) {
  DicomPicture picture;
  picture.seriesUid = std::string(m.uid) + "." + std::to_string(series);
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SpecificCharacterSet, m.charset);
    data.putAndInsertString(DCM_PatientName, m.name);
    data.putAndInsertString(DCM_PatientID, m.id);
    data.putAndInsertString(DCM_StudyInstanceUID, m.uid);
    data.putAndInsertString(DCM_StudyDate, m.date);
    data.putAndInsertString(DCM_StudyTime, "101112");
    data.putAndInsertString(DCM_Modality, m.modality);
    data.putAndInsertString(DCM_StudyDescription, m.description);
    data.putAndInsertString(DCM_SOPInstanceUID, (picture.seriesUid + ".1").c_str());
  };
  const QString path = folder + QStringLiteral("/%1.dcm").arg(QString::fromStdString(picture.seriesUid));
  writeDicom(path.toStdString(), picture);
  return path;
}

QStringList writeAllArchived(const QString& folder) {
  QStringList files;
  for (const ArchivedStudy& study : archivedStudies) files << writeArchived(folder, study, 1);
  return files << writeArchived(folder, archivedStudies[0], 2);
}

QStringList filesBelow(const QString& folder) {
  QStringList files;
  for (QDirIterator all(folder, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories); all.hasNext();)
    files << all.next();
  return files;
}

Instance instanceIn(const QString& path) {
  DcmFileFormat file;
  if (file.loadFile(path.toStdString().c_str()).bad()) return {};
  DcmDataset& data = *file.getDataset();
  volumen::dicom::registerDecoders();
  data.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  const auto text = [&](const DcmTagKey& tag) {
    OFString value;
    data.findAndGetOFStringArray(tag, value);
    return std::string(value.c_str());
  };
  const Uint16* pixels = nullptr;
  unsigned long count = 0;
  data.findAndGetUint16Array(DCM_PixelData, pixels, &count);
  return {text(DCM_SeriesInstanceUID), text(DCM_SOPInstanceUID), text(DCM_PatientName),
          std::vector<unsigned short>(pixels, pixels + count)};
}

QStringList uidsOf(const QJsonArray& studies) {
  QStringList uids;
  for (const QJsonValue& study : studies) uids << study[QStringLiteral("studyUid")].toString();
  uids.sort();
  return uids;
}

}  // namespace volumen::tests
