#pragma once

#include <QByteArray>
#include <QStringList>
#include <functional>
#include <map>

#include "tests/unit/archive/peer_process.h"

namespace volumen::tests {

/// A request that a fake archive gets by HTTP.
struct HttpRequest {
  QByteArray method, path, query, body;      ///< path and query decoded
  std::map<QByteArray, QByteArray> headers;  ///< names in small letters
};

/// Returns an answer: "HTTP/1.1 200 OK" with its length, after which the connection ends.
QByteArray httpAnswer(const QByteArray& status, const QByteArray& type, const QByteArray& body,
                      const QByteArray& moreHeaders = {});

/// A fake archive by HTTP: `answer` returns the bytes to send.
class HttpPeer {
 public:
  explicit HttpPeer(std::function<QByteArray(const HttpRequest&)> answer);
  QByteArray url() const { return "http://127.0.0.1:" + QByteArray::number(peer_.port()) + "/dicom-web"; }

 private:
  FakePeer peer_;
};

/// Returns an answer of a message in parts, each with the bytes of a file.
QByteArray partsOf(const QList<QByteArray>& files, const QByteArray& boundary = "0123456789abcdef01234567");

}  // namespace volumen::tests
