#pragma once

#include <QByteArray>
#include <QList>

/// Parts of PDUs (PS3.8 9.3) and commands (PS3.7 E) by hand, for peers that break the rules.
namespace volumen::tests::pdu {

QByteArray twoBytes(int value);   ///< big endian
QByteArray fourBytes(int value);  ///< big endian

QByteArray item(char type, const QByteArray& value);
QByteArray pdu(char type, const QByteArray& value);

/// Returns a presentation context that proposes a class in these transfer syntaxes.
QByteArray context(int id, const QByteArray& sopClass,
                   const QList<QByteArray>& syntaxes = {QByteArrayLiteral("1.2.840.10008.1.2")});

/// What an association is asked for with.
struct Request {
  QByteArray contexts = context(1, "1.2.840.10008.1.1") + context(3, "1.2.840.10008.5.1.4.1.1.2");
  QByteArray called = "VOLUMEN", calling = "BYHAND";
  QByteArray name = item(0x10, "1.2.840.10008.3.1.1.1");  ///< application context
  int mostBytes = 16384;                                  ///< of a PDU that the peer takes
  QByteArray more = {};                                   ///< items about the user
};
QByteArray associate(const Request& request = {});
QByteArray release();

/// Returns an element of a command.
QByteArray element(int number, QByteArray value);
QByteArray element(int number, int value);
/// Returns a command over a context.
QByteArray command(int context, const QByteArray& elements);
QByteArray echo(int context = 1);
/// Returns a C-STORE of a small image.
QByteArray store(int context = 3);
/// Returns the values (PDV) in several PDUs of data as one PDU.
QByteArray joined(const QByteArray& pdus);

}  // namespace volumen::tests::pdu
