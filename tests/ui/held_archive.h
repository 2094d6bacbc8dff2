#pragma once

#include <QDate>
#include <QThread>
#include <atomic>

#include "io/archive/archives.h"
#include "tests/unit/archive/web_peer.h"

namespace volumen::tests {

/// An archive ("held", DICOMweb) with 600 studies of today, which sends them in pages of 200, the patients
/// P0599 to P0000. It holds back the last page until it is told to send it.
class HeldArchive {
 public:
  ~HeldArchive() { sendRest(); }

  Archive archive() const {
    Archive archive;
    archive.name = "held", archive.kind = ArchiveKind::dicomweb, archive.url = peer_.url().toStdString();
    return archive;
  }
  /// Sends the last page, or ends the line in its place.
  void sendRest() { rest_ = Rest::sent; }
  void hangUp() { rest_ = Rest::lost; }

 private:
  enum class Rest { held, sent, lost };
  static constexpr int pageSize = 200, last = 2 * pageSize;

  static QByteArray studies(int offset) {
    const QByteArray today = QDate::currentDate().toString(QStringLiteral("yyyyMMdd")).toLatin1();
    QByteArray all;
    for (int n = last + pageSize - 1 - offset, end = n - pageSize; n > end && n >= 0; --n) {
      const QByteArray number = QByteArray::number(n).rightJustified(4, '0');
      all += (all.isEmpty() ? "" : ",") + QByteArray(R"({"0020000D": {"Value": ["1.2.9.)") +
             QByteArray::number(n) + R"("]}, "00100010": {"Value": ["P)" + number +
             R"("]}, "00100020": {"Value": ["ID)" + number + R"("]}, "00080020": {"Value": [")" + today +
             R"("]}, "00080061": {"Value": ["CT"]}})";
    }
    return '[' + all + ']';
  }
  QByteArray answerTo(const HttpRequest& request) {
    const auto answer = [](const QByteArray& json) {
      return httpAnswer("200 OK", "application/dicom+json", json);
    };
    if (!request.path.endsWith("/studies")) return answer("[]");
    const qsizetype at = request.query.indexOf("offset=") + 7;
    const int offset = request.query.mid(at, request.query.indexOf('&', at) - at).toInt();
    while (offset == last && rest_ == Rest::held) QThread::msleep(10);
    return offset == last && rest_ == Rest::lost ? QByteArray() : answer(studies(offset));
  }

  std::atomic<Rest> rest_ = Rest::held;
  HttpPeer peer_{[this](const HttpRequest& request) { return answerTo(request); }};
};

}  // namespace volumen::tests
