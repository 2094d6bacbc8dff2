#include "tests/unit/archive/archived_studies.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>

#include <QDirIterator>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtEndian>
#include <algorithm>

#include "io/dicom/decode.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/pdus.h"
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

QList<QByteArray> instancesOfOneSeries(int count) {
  const QTemporaryDir folder;
  const QByteArray first = contentsOf(writeArchived(folder.path(), archivedStudies[0], 1));
  QList<QByteArray> files;
  for (int n = 1; n <= count; ++n)
    files << QByteArray(first).replace("1.2.1.1.1", "1.2.1.1." + QByteArray::number(n));
  return files;
}

QStringList filesBelow(const QString& folder) {
  QStringList files;
  for (QDirIterator all(folder, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories); all.hasNext();)
    files << all.next();
  return files;
}

QList<QByteArray> dataSetsBelow(const QString& folder) {
  QList<QByteArray> all;
  for (const QString& path : filesBelow(folder))
    all << (path.endsWith(QLatin1String(".dcm")) ? dataSetIn(contentsOf(path)) : QByteArray("half-written"));
  std::sort(all.begin(), all.end());
  return all;
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

qsizetype beginOfData(const QByteArray& file) {
  return file.size() < 144 ? 0 : 144 + qsizetype(qFromLittleEndian<quint32>(file.constData() + 140));
}

QByteArray renamed(QByteArray file, const QByteArray& from, QByteArray to) {
  if (to.size() % 2) to += '\0';
  const qsizetype at = file.indexOf(from), size = from.size() + from.size() % 2;
  const auto length = qFromLittleEndian<quint32>(file.constData() + 140);
  qToLittleEndian(quint32(length + to.size() - size), file.data() + 140);
  qToLittleEndian(quint16(to.size()), file.data() + at - 2);
  return file.replace(at, size, to);
}

QStringList uidsOf(const QJsonArray& studies) {
  QStringList uids;
  for (const QJsonValue& study : studies) uids << study[QStringLiteral("studyUid")].toString();
  uids.sort();
  return uids;
}

}  // namespace volumen::tests
