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

inline constexpr const char* jsonType = "application/dicom+json";
/// Returns an answer of that type.
QByteArray jsonAnswer(const QByteArray& body);

/// Returns whether a request asks for a list.
bool isListing(const HttpRequest& request);
/// Returns the lists of a study with one series (1.2.1.1) of three instances (instancesOfOneSeries()).
QByteArray listing(const HttpRequest& request);

/// A fake archive by HTTP: `answer` returns the bytes to send, `beforeEnd` is called when they are sent.
class HttpPeer {
 public:
  explicit HttpPeer(std::function<QByteArray(const HttpRequest&)> answer,
                    std::function<void()> beforeEnd = {});
  QByteArray url() const { return "http://127.0.0.1:" + QByteArray::number(peer_.port()) + "/dicom-web"; }

 private:
  FakePeer peer_;
};

/// Returns an answer of a message in parts, each with the bytes of a file.
QByteArray partsOf(const QList<QByteArray>& files, const QByteArray& boundary = "0123456789abcdef01234567");

/// Writes a list of archives, in which one by DICOMweb is called "main". Returns its path.
QString writeWebListWith(const QByteArray& url, const QString& folder);

}  // namespace volumen::tests
