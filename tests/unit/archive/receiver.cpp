#include "tests/unit/archive/receiver.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <QFile>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

int statusOfPeer(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.setStandardOutputFile(QProcess::nullDevice());
  process.setStandardErrorFile(QProcess::nullDevice());
  process.start(program, arguments);
  return process.waitForFinished(60000) && process.exitStatus() == QProcess::NormalExit ? process.exitCode()
                                                                                        : -1;
}

Receiver::Receiver(const QByteArray& fields, rlim_t mostBytes) : port_(freePort()), mostBytes_(mostBytes) {
  QFile list(folder_.filePath(QStringLiteral("archives.json")));
  if (list.open(QIODevice::WriteOnly))
    list.write("{\"listen\": {\"port\": " + QByteArray::number(port_) + fields + "}}");
}

bool Receiver::start(const QStringList& more) {
  const QStringList to =
      more.contains(QLatin1String("--index")) ? QStringList() : QStringList{QStringLiteral("-o"), output()};
  std::function<void()> before;
  if (mostBytes_ > 0) before = [limit = rlimit{mostBytes_, mostBytes_}] { setrlimit(RLIMIT_FSIZE, &limit); };
  program_.emplace(QStringList{QStringLiteral("receive"), QStringLiteral("--archives"),
                               folder_.filePath(QStringLiteral("archives.json"))} +
                       to + more,
                   before);
  return listensAt(port_);
}

QStringList Receiver::files() const { return filesBelow(output()); }

QStringList Receiver::address() const {
  return {QStringLiteral("-aec"), QStringLiteral("VOLUMEN"), QStringLiteral("127.0.0.1"),
          QString::number(port_)};
}

std::unique_ptr<QTcpSocket> Receiver::connection(const QByteArray& bytes) const {
  auto socket = std::make_unique<QTcpSocket>();
  socket->connectToHost(QStringLiteral("127.0.0.1"), quint16(port_));
  if (socket->waitForConnected(5000) && !bytes.isEmpty())
    socket->write(bytes), socket->waitForBytesWritten(5000);
  return socket;
}

QString writeImage(const QString& path, const char* study, const char* instance, const char* patient,
                   int side) {
  DicomPicture picture{.seriesUid = std::string(study) + ".1", .columns = side, .rows = side};
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_StudyInstanceUID, study);
    data.putAndInsertString(DCM_SOPInstanceUID, instance);
    data.putAndInsertString(DCM_PatientName, patient);
    for (const DcmTagKey& tag : {DCM_StudyInstanceUID, DCM_SOPInstanceUID})
      if (OFString value; data.findAndGetOFString(tag, value).bad() || value.empty())
        data.findAndDeleteElement(tag);
  };
  writeDicom(path.toStdString(), picture);
  return path;
}

}  // namespace volumen::tests
