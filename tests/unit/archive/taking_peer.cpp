#include "tests/unit/archive/taking_peer.h"

#include <QDataStream>
#include <QIODevice>
#include <QtEndian>

namespace volumen::tests {

namespace {

enum PduType : quint8 {
  associateRequest = 1,
  associateAccept,
  rejection,
  data,
  releaseRequest,
  releaseAnswer
};

// Items of PDUs (PS3.8 9.3) have a type, a byte that is 0, and a length of two bytes.
QByteArray itemOf(quint8 type, const QByteArray& value) {
  QByteArray bytes;
  QDataStream out(&bytes, QIODevice::WriteOnly);
  out << type << quint8(0) << quint16(value.size());
  return bytes + value;
}

QByteArray messageOf(PduType type, const QByteArray& value) {
  QByteArray bytes;
  QDataStream out(&bytes, QIODevice::WriteOnly);
  out << quint8(type) << quint8(0) << quint32(value.size());
  return bytes + value;
}

void forEachItem(const QByteArray& items, const std::function<void(quint8, const QByteArray&)>& visit) {
  for (qsizetype at = 0; at + 4 <= items.size();) {
    const qsizetype size = qFromBigEndian<quint16>(items.constData() + at + 2);
    visit(quint8(items[at]), items.mid(at + 4, size));
    at += 4 + size;
  }
}

// An element of a command (PS3.7 E): implicit VR, little endian.
QByteArray inCommand(quint16 element, const QByteArray& value) {
  QByteArray bytes;
  QDataStream out(&bytes, QIODevice::WriteOnly);
  out.setByteOrder(QDataStream::LittleEndian);
  out << quint16(0) << element << quint32(value.size());
  return bytes + value;
}

// The answer "stored" to a C-STORE request.
QByteArray storedAnswer(const QByteArray& command) {
  const qsizetype messageId = command.indexOf(QByteArray("\0\0\x10\1\2\0\0\0", 8));
  const QByteArray answer =
      inCommand(0x0100, QByteArray("\x01\x80", 2)) + inCommand(0x0120, command.mid(messageId + 8, 2)) +
      inCommand(0x0800, QByteArray("\x01\x01", 2)) + inCommand(0x0900, QByteArray(2, '\0'));
  QByteArray length(4, '\0');
  qToLittleEndian(quint32(answer.size()), length.data());
  return inCommand(0, length) + answer;
}

bool take(QTcpSocket& socket, qsizetype count, QByteArray& bytes) {
  while (socket.bytesAvailable() < count)
    if (!socket.waitForReadyRead(10000)) return false;
  bytes = socket.read(count);
  return true;
}

}  // namespace

TakingPeer::TakingPeer(QByteArrayList syntaxes)
    : syntaxes_(std::move(syntaxes)), peer_([this](QTcpSocket& socket) { serve(socket); }) {}

QByteArrayList TakingPeer::dataSets() const {
  const QMutexLocker one(&mutex_);
  return dataSets_;
}

void TakingPeer::serve(QTcpSocket& socket) {
  QByteArray head, body;
  while (take(socket, 6, head) && take(socket, qFromBigEndian<quint32>(head.constData() + 2), body)) {
    const auto type = PduType(head[0]);
    if (type == associateRequest) socket.write(accepted(body));
    if (type == data) socket.write(answerTo(body));
    if (type == releaseRequest) socket.write(messageOf(releaseAnswer, QByteArray(4, '\0')));
    socket.flush();
    if (type == releaseRequest) break;
  }
  socket.waitForDisconnected(1000);
}

QByteArray TakingPeer::accepted(const QByteArray& request) const {
  constexpr qsizetype items = 68;
  QByteArray answer;
  forEachItem(request.mid(items), [&](quint8 type, const QByteArray& item) {
    if (type == 0x10) answer += itemOf(0x10, item);
    if (type == 0x50) answer += itemOf(0x50, itemOf(0x51, QByteArray("\0\0\x40\0", 4)));
    if (type != 0x20) return;
    QByteArray chosen;
    forEachItem(item.mid(4), [&](quint8 kind, const QByteArray& syntax) {
      if (kind == 0x40 && chosen.isEmpty() && (syntaxes_.isEmpty() || syntaxes_.contains(syntax)))
        chosen = syntax;
    });
    const char result = chosen.isEmpty() ? 4 : 0;
    answer += itemOf(0x21, QByteArray{item.left(1)} + '\0' + result + '\0' + itemOf(0x40, chosen));
  });
  return messageOf(associateAccept, request.left(items) + answer);
}

QByteArray TakingPeer::answerTo(const QByteArray& pdu) {
  QByteArray answer;
  for (qsizetype at = 0; at + 6 <= pdu.size();) {
    const qsizetype size = qFromBigEndian<quint32>(pdu.constData() + at);
    const char context = pdu[at + 4], control = pdu[at + 5];
    (control & 1 ? command_ : data_) += pdu.mid(at + 6, size - 2);
    at += 4 + size;
    if (control != 2) continue;  // the last part of a data set
    const QByteArray message = storedAnswer(command_);
    QByteArray length(4, '\0');
    qToBigEndian(quint32(message.size() + 2), length.data());
    answer += messageOf(data, length + context + '\3' + message);
    const QMutexLocker one(&mutex_);
    dataSets_ << data_;
    command_.clear(), data_.clear();
  }
  return answer;
}

}  // namespace volumen::tests
