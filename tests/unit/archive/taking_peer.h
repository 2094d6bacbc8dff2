#pragma once

#include <QByteArrayList>
#include <QMutex>

#include "tests/unit/archive/peer_process.h"

namespace volumen::tests {

/// A peer that keeps the bytes of all data sets that it is sent by C-STORE, in any transfer syntax, also in
/// those that DCMTK does not know.
class TakingPeer {
 public:
  /// It takes only these transfer syntaxes; if none are given, the first that is proposed in each context.
  explicit TakingPeer(QByteArrayList syntaxes = {});
  int port() const { return peer_.port(); }
  QByteArrayList dataSets() const;

 private:
  void serve(QTcpSocket& socket);
  QByteArray accepted(const QByteArray& request) const;
  QByteArray answerTo(const QByteArray& pdu);

  const QByteArrayList syntaxes_;
  mutable QMutex mutex_;
  QByteArrayList dataSets_;
  QByteArray command_, data_;  // of the message that is coming
  FakePeer peer_;
};

}  // namespace volumen::tests
