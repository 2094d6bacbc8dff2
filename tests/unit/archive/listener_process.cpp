#include "tests/unit/archive/listener_process.h"

#include <signal.h>

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <QElapsedTimer>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

ListenerProcess::ListenerProcess(const QByteArray& fields) : port_(freePort()) {
  QFile list(in("archives.json"));
  if (list.open(QIODevice::WriteOnly))
    list.write("{\"listen\": {\"port\": " + QByteArray::number(port_) + fields + "}}");
}

ListenerProcess::~ListenerProcess() { kill(); }

void ListenerProcess::kill() {
  process_.kill();
  process_.waitForFinished();
}

bool ListenerProcess::start(bool intoIndex) {
  process_.start(QStringLiteral(VOLUMEN_PROGRAM),
                 {QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                  in("archives.json"), intoIndex ? QStringLiteral("--index") : QStringLiteral("-o"),
                  intoIndex ? index() : output()});
  QElapsedTimer since;
  QByteArray said;
  for (since.start(); since.elapsed() < 20000 && process_.state() != QProcess::NotRunning;) {
    process_.waitForReadyRead(50);
    said += process_.readAllStandardError();
    if (said.contains("Listening at ")) return true;
  }
  return false;
}

std::optional<QByteArray> ListenerProcess::interrupted() {
  ::kill(pid_t(process_.processId()), SIGINT);
  if (!process_.waitForFinished(30000) || process_.exitStatus() != QProcess::CrashExit ||
      process_.exitCode() != SIGINT)
    return {};
  return process_.readAllStandardOutput();
}

QStringList ListenerProcess::files() const { return filesBelow(output()); }

QJsonArray ListenerProcess::studies() const {
  const Outcome listed =
      runProgram({QStringLiteral("list"), QStringLiteral("--index"), index(), QStringLiteral("--json")});
  return QJsonDocument::fromJson(listed.out)[QStringLiteral("studies")].toArray();
}

int ListenerProcess::statusOf(const QString& program, const QStringList& options, const QStringList& files,
                              const QString& host) const {
  QProcess peer;
  peer.setStandardOutputFile(QProcess::nullDevice());
  peer.setStandardErrorFile(QProcess::nullDevice());
  QStringList arguments = options;
  if (!options.contains(QLatin1String("-aec")))
    arguments << QStringLiteral("-aec") << QStringLiteral("VOLUMEN");
  peer.start(program, arguments + QStringList{host, QString::number(port_)} + files);
  const bool ended = peer.waitForFinished(60000) && peer.exitStatus() == QProcess::NormalExit;
  return ended ? peer.exitCode() : -1;
}

std::unique_ptr<QTcpSocket> ListenerProcess::connection(const QByteArray& bytes) const {
  auto socket = std::make_unique<QTcpSocket>();
  socket->connectToHost(QStringLiteral("127.0.0.1"), quint16(port_));
  if (socket->waitForConnected(5000) && !bytes.isEmpty())
    socket->write(bytes), socket->waitForBytesWritten(5000);
  return socket;
}

QString ListenerProcess::writeImage(const char* study, const char* instance) const {
  const QString path = in(instance);
  DicomPicture picture{.seriesUid = std::string(study) + ".1"};
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_StudyInstanceUID, study);
    data.putAndInsertString(DCM_SOPInstanceUID, instance);
  };
  writeDicom(path.toStdString(), picture);
  return path;
}

bool isClosed(QTcpSocket& socket) {
  return socket.state() == QAbstractSocket::UnconnectedState || socket.waitForDisconnected(15000);
}

}  // namespace volumen::tests
