#include "tests/unit/archive/dicom_pdus.h"

#include <QtEndian>
#include <algorithm>

namespace volumen::tests::pdu {

namespace {

QByteArray reversed(QByteArray bytes) {
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

// Returns a part of a command (control 3) or a data set (2): its last.
QByteArray lastPart(int context, char control, const QByteArray& value) {
  return pdu(4, fourBytes(int(value.size()) + 2) + char(context) + control + value);
}

QByteArray dataElement(int group, int number, const QByteArray& value) {
  return reversed(twoBytes(group)) + reversed(twoBytes(number)) + reversed(fourBytes(int(value.size()))) +
         value;
}

QByteArray bytesOf(quint32 value) {
  char bytes[sizeof value];
  qToBigEndian(value, bytes);
  return {bytes, sizeof value};
}

}  // namespace

QByteArray twoBytes(int value) { return bytesOf(quint32(value)).right(2); }
QByteArray fourBytes(int value) { return bytesOf(quint32(value)); }

QByteArray item(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + twoBytes(int(value.size())) + value;
}
QByteArray pdu(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + fourBytes(int(value.size())) + value;
}

QByteArray context(int id, const QByteArray& sopClass, const QList<QByteArray>& syntaxes) {
  QByteArray value = QByteArray(1, char(id)) + QByteArray(3, '\0') + item(0x30, sopClass);
  for (const QByteArray& syntax : syntaxes) value += item(0x40, syntax);
  return item(0x20, value);
}

QByteArray associate(const Request& request) {
  return pdu(
      1, twoBytes(1) + twoBytes(0) + request.called.leftJustified(16) + request.calling.leftJustified(16) +
             QByteArray(32, '\0') + request.name + request.contexts +
             item(0x50, item(0x51, fourBytes(request.mostBytes)) + item(0x52, "1.2.3") + request.more));
}
QByteArray release() { return pdu(5, QByteArray(4, '\0')); }

QByteArray element(int number, QByteArray value) {
  if (value.size() % 2) value += '\0';
  return dataElement(0, number, value);
}
QByteArray element(int number, int value) { return dataElement(0, number, reversed(twoBytes(value))); }

QByteArray command(int context, const QByteArray& elements) {
  return lastPart(context, 3, dataElement(0, 0, reversed(fourBytes(int(elements.size())))) + elements);
}

QByteArray echo(int context) {
  return command(context, element(0x0002, "1.2.840.10008.1.1") + element(0x0100, 0x0030) +
                              element(0x0110, 7) + element(0x0800, 0x0101));
}

QByteArray store(int context) {
  const QByteArray sopClass = "1.2.840.10008.5.1.4.1.1.2", uid = "1.2.3.1.9";
  const QByteArray data = dataElement(0x0008, 0x0016, sopClass + '\0') +
                          dataElement(0x0008, 0x0018, uid + '\0') +
                          dataElement(0x0020, 0x000d, QByteArray("1.2.3\0", 6)) +
                          dataElement(0x0020, 0x000e, QByteArray("1.2.3.1\0", 8));
  return command(context, element(0x0002, sopClass) + element(0x0100, 0x0001) + element(0x0110, 9) +
                              element(0x0700, 0) + element(0x0800, 1) + element(0x1000, uid)) +
         lastPart(context, 2, data);
}

QByteArray joined(const QByteArray& pdus) {
  constexpr qsizetype head = 6;
  QByteArray values;
  for (qsizetype at = 0; at < pdus.size();) {
    const qsizetype length = qsizetype(qFromBigEndian<quint32>(pdus.constData() + at + 2));
    values += pdus.mid(at + head, length);
    at += head + length;
  }
  return pdu(4, values);
}

}  // namespace volumen::tests::pdu
