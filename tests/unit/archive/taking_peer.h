#pragma once

#include <QByteArrayList>
#include <QMutex>

#include "tests/unit/archive/fake_scp.h"

namespace volumen::tests {

/// A peer that keeps the bytes of all data sets that it is sent by C-STORE, in any transfer syntax, also in
/// those that DCMTK does not know.
class TakingPeer {
 public:
  /// It takes only these transfer syntaxes; if none are given, the first that is proposed in each context.
  explicit TakingPeer(const QByteArrayList& syntaxes = {});
  int port() const { return peer_.port(); }
  QByteArrayList dataSets() const;

 private:
  mutable QMutex mutex_;
  QByteArrayList dataSets_;
  FakeScp peer_;
};

}  // namespace volumen::tests
