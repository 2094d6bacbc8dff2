#pragma once

#include <QByteArray>
#include <QList>
#include <functional>
#include <optional>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/pdus.h"
#include "tests/unit/archive/peer_process.h"

namespace volumen::tests {

/// Command fields of requests (PS3.7 E.1).
inline constexpr quint16 storeRequest = 0x0001, getRequest = 0x0010, findRequest = 0x0020;
/// A status (PS3.7 C): more follows.
inline constexpr quint16 pendingStatus = 0xff00;

/// A message of DIMSE (PS3.7 6.3).
struct DimseMessage {
  int context = 0;
  QByteArray command, data;

  quint16 field() const;  ///< which command it is
  quint16 id() const;
  /// Returns a text of its data set in Implicit VR, without padding.
  QByteArray text(quint16 group, quint16 element) const;
  /// Returns the level of a search: "SERIES".
  QByteArray level() const { return text(0x0008, 0x0052); }
};

/// A response (PS3.7 9.1). What it says may be wrong.
struct DimseResponse {
  quint16 status = 0;
  QByteArray data = {};
  QByteArray instanceUid = {};  ///< empty: as asked
  int idOffset = 0;             ///< of the message that it claims to answer
  bool hasStatus = true;
};
/// Returns the PDUs of a response to a request.
QByteArray responseTo(const DimseMessage& request, const DimseResponse& response = {});

/// An association, as the archive sees it.
class ScpLine {
 public:
  ScpLine(QTcpSocket& socket, const QByteArray& request) : socket_(socket), contexts_(contextsIn(request)) {}

  bool isOpen() const { return socket_.state() == QTcpSocket::ConnectedState; }
  /// Returns the next message; nothing if the association has ended.
  std::optional<DimseMessage> receive();
  /// Sends bytes, unless the peer has left.
  void send(const QByteArray& bytes);
  /// Sends one byte after another, each after `ms`.
  void drip(const QByteArray& bytes, unsigned long ms);
  /// Closes the connection after all that was sent.
  void hangUp();
  /// Sends nothing more until the peer leaves.
  void fallSilent();
  /// Returns the PDUs of a C-STORE sub-operation with an instance in Explicit VR.
  QByteArray storage(const QByteArray& instanceUid, const QByteArray& dataSet) const;

 private:
  friend class FakeScp;
  QByteArray take(qsizetype count);

  QTcpSocket& socket_;
  const QList<ProposedContext> contexts_;
  QByteArray received_;
};

/// What an archive does about a request.
using ScpAnswer = std::function<void(ScpLine&, const DimseMessage&)>;

/// A fake archive by DIMSE, one association after the other. It answers as it is told.
class FakeScp {
 public:
  explicit FakeScp(ScpAnswer answer, ChosenSyntax chosen = lastSyntax);
  int port() const { return peer_.port(); }

 private:
  FakePeer peer_;
};

/// Answers as an archive does that holds instances of the study 1.2.1 and its series 1.2.1.1, numbered from
/// 1.2.1.1.1 (instancesOfOneSeries()).
void answerRightly(ScpLine& line, const DimseMessage& request, const QList<QByteArray>& files);

/// Returns a data set that answers a search with one study.
QByteArray foundStudy(const QByteArray& uid);

/// Writes a list of archives, in which one at this port is called "main". Returns its path.
QString writeListWith(int port, const QString& folder);
/// Runs `volumen archive` with this list.
Outcome runArchive(int port, const QStringList& words);

}  // namespace volumen::tests
