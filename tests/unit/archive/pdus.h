#pragma once

#include <QByteArray>
#include <QList>
#include <QtEndian>
#include <functional>

namespace volumen::tests {

// Protocol data units (PS3.8 9.3) and commands (PS3.7 E) by hand, for peers that break the rules.

template <class T>
QByteArray bigEndian(T value) {
  char bytes[sizeof(T)];
  qToBigEndian(value, bytes);
  return {bytes, sizeof(T)};
}
template <class T>
QByteArray littleEndian(T value) {
  char bytes[sizeof(T)];
  qToLittleEndian(value, bytes);
  return {bytes, sizeof(T)};
}

/// Types of PDUs (PS3.8 9.3.1).
inline constexpr char pduRequest = 1, pduAcceptance = 2, pduData = 4, pduReleaseRequest = 5,
                      pduReleaseAnswer = 6, pduAbort = 7;

/// Returns a PDU: its type, a reserved byte, the length in four bytes, the value.
QByteArray pduOf(char type, const QByteArray& value);
/// Returns an item of a PDU, whose length has two bytes (PS3.8 9.3.2).
QByteArray pduItem(char type, const QByteArray& value);

/// Returns a presentation context that proposes a class in these transfer syntaxes (PS3.8 9.3.2.2).
QByteArray proposalOf(int id, const QByteArray& sopClass,
                      const QList<QByteArray>& syntaxes = {QByteArrayLiteral("1.2.840.10008.1.2")});

/// What an association is asked for with.
struct AssociationRequest {
  QByteArray contexts = proposalOf(1, "1.2.840.10008.1.1") + proposalOf(3, "1.2.840.10008.5.1.4.1.1.2");
  QByteArray called = "VOLUMEN", calling = "BYHAND";
  QByteArray name = pduItem(0x10, "1.2.840.10008.3.1.1.1");  ///< application context
  quint32 mostBytes = 16384;                                 ///< of a PDU that the peer takes
  QByteArray more = {};                                      ///< items about the user
};
/// Returns an A-ASSOCIATE-RQ (PS3.8 9.3.2).
QByteArray associationRequest(const AssociationRequest& request = {});
/// Returns an A-RELEASE-RQ (PS3.8 9.3.6).
QByteArray releaseRequest();

/// A presentation context that a peer proposes (PS3.8 9.3.2.2).
struct ProposedContext {
  int id;
  QByteArray sopClass;
  QList<QByteArray> syntaxes;
};
/// Returns the contexts in an A-ASSOCIATE-RQ.
QList<ProposedContext> contextsIn(const QByteArray& request);
/// Returns which of the transfer syntaxes of a context is accepted; empty: none.
using ChosenSyntax = std::function<QByteArray(const ProposedContext&)>;
QByteArray lastSyntax(const ProposedContext& context);
/// Returns the A-ASSOCIATE-AC (PS3.8 9.3.3) that accepts the contexts of a request, and all roles.
QByteArray acceptanceOf(const QByteArray& request, const ChosenSyntax& chosen);

/// Returns a P-DATA-TF with a fragment of a message (PS3.8 9.3.5, E.2). `control`: 1: of a command, 2: the
/// last.
QByteArray dataPdu(int context, int control, const QByteArray& fragment);
/// Returns fragments of a whole command or data set, each in a PDU of at most 16 KiB.
QByteArray dataPdus(int context, bool isCommand, const QByteArray& bytes);

/// Returns an element in Implicit VR Little Endian (PS3.5 7.1.3), of even length.
QByteArray implicitElement(quint16 group, quint16 element, QByteArray value);
/// Returns one of a command (group 0000).
QByteArray commandElement(quint16 element, const QByteArray& value);
QByteArray commandElement(quint16 element, quint16 value);
/// Returns the bytes of a DIMSE command: the length of the group, then its elements (PS3.7 6.3.1).
QByteArray commandOf(const QByteArray& elements);
/// Returns a short one in a PDU.
QByteArray commandPdu(int context, const QByteArray& elements);
/// Returns the value of an element in bytes of Implicit VR Little Endian, with its padding; empty if there is
/// none.
QByteArray valueIn(const QByteArray& bytes, quint16 group, quint16 element);

/// Returns a C-ECHO request (PS3.7 9.3.5.1).
QByteArray echoPdu();
/// Returns a C-STORE request (PS3.7 9.3.1.1) with a small image.
QByteArray storagePdus(int context = 3);
/// Returns the request and the begin of its data set.
QByteArray begunStorage();
/// Returns the values (PDV) in several PDUs of data as one PDU.
QByteArray joined(const QByteArray& pdus);
/// Returns sequences within sequences (0040,0275), never closed, of 16 bytes each.
QByteArray nestedSequences(int levels);
/// Returns a command of 25,000 sequences within each other: 400 kB, in fragments.
QByteArray deepCommand();
/// Returns the begin of a PDU whose length field claims 4 GiB, with a few bytes of its data.
QByteArray endlessPdu();

/// Returns what follows the file meta information (PS3.10 7.1) in the bytes of a file.
QByteArray dataSetIn(const QByteArray& file);

}  // namespace volumen::tests
