#include "tests/unit/archive/receiver.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <QFile>
#include <QJsonDocument>
#include <QProcess>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

namespace {

int statusOfPeer(const QString& program, const QStringList& arguments) {
  QProcess peer;
  peer.setStandardOutputFile(QProcess::nullDevice());
  peer.setStandardErrorFile(QProcess::nullDevice());
  peer.start(program, arguments);
  const bool ended = peer.waitForFinished(60000) && peer.exitStatus() == QProcess::NormalExit;
  return ended ? peer.exitCode() : -1;
}

}  // namespace

Receiver::Receiver(const QByteArray& fields, rlim_t mostBytes) : port_(freePort()), mostBytes_(mostBytes) {
  QFile list(folder_.filePath(QStringLiteral("archives.json")));
  if (list.open(QIODevice::WriteOnly))
    list.write("{\"listen\": {\"port\": " + QByteArray::number(port_) + fields + "}}");
}

bool Receiver::start(const QStringList& more) { return startInto(QStringLiteral("-o"), output(), more); }

bool Receiver::startIntoIndex() { return startInto(QStringLiteral("--index"), index(), {}); }

bool Receiver::startInto(const QString& option, const QString& folder, const QStringList& more) {
  std::function<void()> before;
  if (mostBytes_ > 0) before = [limit = rlimit{mostBytes_, mostBytes_}] { setrlimit(RLIMIT_FSIZE, &limit); };
  program_.emplace(QStringList{QStringLiteral("receive"), QStringLiteral("--archives"),
                               folder_.filePath(QStringLiteral("archives.json")), option, folder} +
                       more,
                   before);
  return program_->says("Listening at ");
}

QStringList Receiver::files() const { return filesBelow(output()); }

QJsonArray Receiver::studies() const {
  const Outcome listed =
      runProgram({QStringLiteral("list"), QStringLiteral("--index"), index(), QStringLiteral("--json")});
  return QJsonDocument::fromJson(listed.out)[QStringLiteral("studies")].toArray();
}

QStringList Receiver::call(const QStringList& options) const {
  QStringList arguments = options;
  if (!options.contains(QLatin1String("-aec")))
    arguments << QStringLiteral("-aec") << QStringLiteral("VOLUMEN");
  return arguments << QStringLiteral("127.0.0.1") << QString::number(port_);
}

int Receiver::send(const QStringList& files, const QStringList& options) const {
  return statusOfPeer(QStringLiteral("storescu"), call(options) + files);
}

int Receiver::echo(const QStringList& options) const {
  return statusOfPeer(QStringLiteral("echoscu"), call(options));
}

std::unique_ptr<QTcpSocket> Receiver::connection(const QByteArray& bytes) const {
  auto socket = std::make_unique<QTcpSocket>();
  socket->connectToHost(QStringLiteral("127.0.0.1"), quint16(port_));
  if (socket->waitForConnected(5000) && !bytes.isEmpty())
    socket->write(bytes), socket->waitForBytesWritten(5000);
  return socket;
}

bool isClosed(QTcpSocket& socket) {
  return socket.state() == QAbstractSocket::UnconnectedState || socket.waitForDisconnected(15000);
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
