#include "tests/unit/archive/web_peer.h"

#include <QFile>

namespace volumen::tests {

namespace {

HttpRequest requestFrom(QTcpSocket& socket) {
  QByteArray all;
  while (!all.contains("\r\n\r\n") && socket.waitForReadyRead(5000)) all += socket.readAll();
  const qsizetype end = all.indexOf("\r\n\r\n");
  HttpRequest request;
  const QList<QByteArray> lines = all.left(end).split('\n');
  const QList<QByteArray> first = lines[0].split(' ');
  if (first.size() < 2) return request;
  const qsizetype question = first[1].indexOf('?');
  request.method = first[0];
  request.path = QByteArray::fromPercentEncoding(question < 0 ? first[1] : first[1].left(question));
  if (question >= 0) request.query = QByteArray::fromPercentEncoding(first[1].mid(question + 1));
  for (const QByteArray& line : lines.mid(1))
    request.headers[line.left(line.indexOf(':')).toLower()] = line.mid(line.indexOf(':') + 1).trimmed();
  request.body = all.mid(end + 4);
  const qsizetype length = request.headers["content-length"].toLongLong();
  while (request.body.size() < length && socket.waitForReadyRead(5000)) request.body += socket.readAll();
  return request;
}

}  // namespace

QByteArray httpAnswer(const QByteArray& status, const QByteArray& type, const QByteArray& body,
                      const QByteArray& moreHeaders) {
  return "HTTP/1.1 " + status + "\r\nContent-Type: " + type +
         "\r\nContent-Length: " + QByteArray::number(body.size()) + "\r\n" + moreHeaders +
         "Connection: close\r\n\r\n" + body;
}

QByteArray jsonAnswer(const QByteArray& body) { return httpAnswer("200 OK", jsonType, body); }

QByteArray listing(const HttpRequest& request) {
  if (!request.query.contains("offset=0")) return jsonAnswer("[]");
  if (request.path.endsWith("/series"))
    return jsonAnswer(R"([{"0020000E": {"vr": "UI", "Value": ["1.2.1.1"]}, "00080060": {"Value": ["CT"]}}])");
  QByteArray all;
  for (const char* uid : {"1.2.1.1.1", "1.2.1.1.2", "1.2.1.1.3"})
    all +=
        (all.isEmpty() ? "" : ",") + QByteArray(R"({"00080018": {"vr": "UI", "Value": [")") + uid + "\"]}}";
  return jsonAnswer("[" + all + "]");
}

bool isListing(const HttpRequest& request) { return !request.query.isEmpty(); }

HttpPeer::HttpPeer(std::function<QByteArray(const HttpRequest&)> answer, std::function<void()> beforeEnd)
    : peer_([answer = std::move(answer), beforeEnd = std::move(beforeEnd)](QTcpSocket& socket) {
        const QByteArray bytes = answer(requestFrom(socket));
        for (qsizetype at = 0; at < bytes.size() && socket.state() == QTcpSocket::ConnectedState;) {
          at += socket.write(bytes.mid(at, 1 << 16));
          socket.waitForBytesWritten(5000);
        }
        if (beforeEnd) beforeEnd();
        socket.disconnectFromHost();
        if (socket.state() != QTcpSocket::UnconnectedState) socket.waitForDisconnected(5000);
      }) {}

QByteArray partsOf(const QList<QByteArray>& files, const QByteArray& boundary) {
  QByteArray body;
  for (const QByteArray& file : files)
    body += "--" + boundary + "\r\nContent-Type: application/dicom\r\n\r\n" + file + "\r\n";
  body += "--" + boundary + "--\r\n";
  return httpAnswer("200 OK", "multipart/related; type=\"application/dicom\"; boundary=\"" + boundary + "\"",
                    body);
}

QString writeWebListWith(const QByteArray& url, const QString& folder) {
  QFile list(folder + QStringLiteral("/web.json"));
  if (list.open(QIODevice::WriteOnly))
    list.write(R"({"archives": [{"name": "main", "kind": "dicomweb", "url": ")" + url + "\"}]}");
  return list.fileName();
}

}  // namespace volumen::tests
