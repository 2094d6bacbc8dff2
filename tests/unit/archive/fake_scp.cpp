#include "tests/unit/archive/fake_scp.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <QFile>
#include <QTemporaryDir>
#include <algorithm>

namespace volumen::tests {

namespace {

constexpr int longestSilence = 60000;  // ms
constexpr quint16 noDataSet = 0x0101;

quint16 numberIn(const QByteArray& command, quint16 element) {
  const QByteArray value = valueIn(command, 0, element);
  return value.size() < 2 ? 0 : qFromLittleEndian<quint16>(value.constData());
}

QByteArray keysOf(const QByteArray& level, const QByteArray& instanceUid) {
  QByteArray keys;
  if (!instanceUid.isEmpty())
    keys +=
        implicitElement(0x0008, 0x0016, UID_CTImageStorage) + implicitElement(0x0008, 0x0018, instanceUid);
  return keys + implicitElement(0x0008, 0x0052, level) + implicitElement(0x0008, 0x0060, "CT") +
         implicitElement(0x0020, 0x000d, "1.2.1") + implicitElement(0x0020, 0x000e, "1.2.1.1");
}

QByteArray uidOfNumber(qsizetype n) { return "1.2.1.1." + QByteArray::number(n + 1); }

void answerSearch(ScpLine& line, const DimseMessage& request, qsizetype count) {
  const auto pending = [&](const QByteArray& data) {
    line.send(responseTo(request, {.status = pendingStatus, .data = data}));
  };
  const QByteArray level = request.level();
  if (level == "STUDY") pending(foundStudy("1.2.1"));
  if (level == "SERIES") pending(keysOf("SERIES", {}));
  for (qsizetype n = 0; level == "IMAGE" && n < count; ++n) pending(keysOf("IMAGE", uidOfNumber(n)));
  line.send(responseTo(request));
}

void answerRetrieval(ScpLine& line, const DimseMessage& request, const QList<QByteArray>& files) {
  const QByteArray asked = request.text(0x0008, 0x0018);
  const QList<QByteArray> wanted = asked.split('\\');
  for (qsizetype n = 0; n < files.size(); ++n) {
    if (!asked.isEmpty() && !wanted.contains(uidOfNumber(n))) continue;
    line.send(line.storage(uidOfNumber(n), dataSetIn(files[n])));
    if (!line.receive()) return;
  }
  line.send(responseTo(request));
}

}  // namespace

quint16 DimseMessage::field() const { return numberIn(command, 0x0100); }
quint16 DimseMessage::id() const { return numberIn(command, 0x0110); }

QByteArray DimseMessage::text(quint16 group, quint16 element) const {
  return QByteArray(valueIn(data, group, element).constData()).trimmed();
}

QByteArray responseTo(const DimseMessage& request, const DimseResponse& response) {
  const bool hasData = !response.data.isEmpty();
  QByteArray elements = commandElement(0x0002, valueIn(request.command, 0, 0x0002)) +
                        commandElement(0x0100, quint16(request.field() | 0x8000)) +
                        commandElement(0x0120, quint16(request.id() + response.idOffset)) +
                        commandElement(0x0800, hasData ? quint16(1) : noDataSet);
  if (response.hasStatus) elements += commandElement(0x0900, response.status);
  const QByteArray asked = valueIn(request.command, 0, 0x1000);
  const QByteArray uid = response.instanceUid.isEmpty() ? asked : response.instanceUid;
  if (!uid.isEmpty()) elements += commandElement(0x1000, uid);
  const QByteArray command = dataPdus(request.context, true, commandOf(elements));
  return hasData ? command + dataPdus(request.context, false, response.data) : command;
}

QByteArray ScpLine::take(qsizetype count) {
  while (received_.size() < count) {
    if (socket_.isOpen()) received_ += socket_.readAll();
    if (received_.size() < count && !socket_.waitForReadyRead(longestSilence)) return {};
  }
  const QByteArray bytes = received_.left(count);
  received_.remove(0, count);
  return bytes;
}

std::optional<DimseMessage> ScpLine::receive() {
  DimseMessage message;
  for (;;) {
    const QByteArray head = take(6);
    if (head.isEmpty()) return {};
    const QByteArray value = take(qFromBigEndian<quint32>(head.constData() + 2));
    if (head[0] == pduReleaseRequest) send(pduOf(pduReleaseAnswer, QByteArray(4, '\0')));
    if (head[0] != pduData) return {};
    for (qsizetype at = 0; at + 6 <= value.size();) {
      const qsizetype length = qFromBigEndian<quint32>(value.constData() + at) - 2;
      const int control = value[at + 5];
      message.context = quint8(value[at + 4]);
      (control & 1 ? message.command : message.data) += value.mid(at + 6, length);
      at += 6 + length;
      const bool isLast = control & 2, isCommand = control & 1;
      if (isLast && (!isCommand || numberIn(message.command, 0x0800) == noDataSet)) return message;
    }
  }
}

void ScpLine::send(const QByteArray& bytes) {
  constexpr qsizetype atOnce = 1 << 16;
  for (qsizetype at = 0; at < bytes.size() && isOpen(); at += atOnce) {
    socket_.write(bytes.mid(at, atOnce));
    while (socket_.bytesToWrite() > 0 && isOpen()) socket_.waitForBytesWritten(1000);
  }
}

void ScpLine::drip(const QByteArray& bytes, unsigned long ms) {
  for (qsizetype at = 0; at < bytes.size() && isOpen(); ++at) {
    QThread::msleep(ms);
    send(bytes.mid(at, 1));
  }
}

void ScpLine::hangUp() {
  socket_.disconnectFromHost();
  if (socket_.state() != QTcpSocket::UnconnectedState) socket_.waitForDisconnected(1000);
}

void ScpLine::fallSilent() {
  while (isOpen() && socket_.waitForReadyRead(longestSilence)) socket_.readAll();
}

QByteArray ScpLine::storage(const QByteArray& instanceUid, const QByteArray& dataSet) const {
  const auto context = std::ranges::find_if(contexts_, [](const ProposedContext& one) {
    return one.sopClass == UID_CTImageStorage &&
           one.syntaxes.last() == UID_LittleEndianExplicitTransferSyntax;
  });
  const int id = context == contexts_.end() ? 1 : context->id;
  return dataPdus(
             id, true,
             commandOf(commandElement(0x0002, UID_CTImageStorage) + commandElement(0x0100, storeRequest) +
                       commandElement(0x0110, quint16(1)) + commandElement(0x0700, quint16(0)) +
                       commandElement(0x0800, quint16(1)) + commandElement(0x1000, instanceUid))) +
         dataPdus(id, false, dataSet);
}

FakeScp::FakeScp(ScpAnswer answer, ChosenSyntax chosen)
    : peer_([answer = std::move(answer), chosen = std::move(chosen)](QTcpSocket& socket) {
        ScpLine begin(socket, {});
        const QByteArray head = begin.take(6);
        if (head.isEmpty()) return;
        const QByteArray request = head + begin.take(qFromBigEndian<quint32>(head.constData() + 2));
        ScpLine line(socket, request);
        line.send(acceptanceOf(request, chosen));
        while (const std::optional<DimseMessage> message = line.receive()) answer(line, *message);
        line.hangUp();
      }) {}

void answerRightly(ScpLine& line, const DimseMessage& request, const QList<QByteArray>& files) {
  if (request.field() == findRequest)
    answerSearch(line, request, files.size());
  else if (request.field() == getRequest)
    answerRetrieval(line, request, files);
  else
    line.send(responseTo(request));
}

QByteArray foundStudy(const QByteArray& uid) {
  return implicitElement(0x0008, 0x0052, "STUDY") + implicitElement(0x0010, 0x0020, "PID1") +
         implicitElement(0x0020, 0x000d, uid);
}

QString writeListWith(int port, const QString& folder) {
  QFile list(folder + QStringLiteral("/archives.json"));
  if (list.open(QIODevice::WriteOnly))
    list.write(R"({"archives": [{"name": "main", "kind": "dimse", "host": "127.0.0.1", "port": )" +
               QByteArray::number(port) + R"(, "calledAe": "FAKE"}]})");
  return list.fileName();
}

Outcome runArchive(int port, const QStringList& words) {
  const QTemporaryDir folder;
  return runProgram(QStringList{QStringLiteral("archive")} + words +
                    QStringList{QStringLiteral("--archives"), writeListWith(port, folder.path())});
}

}  // namespace volumen::tests
