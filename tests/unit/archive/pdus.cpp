#include "tests/unit/archive/pdus.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

namespace volumen::tests {

namespace {

constexpr qsizetype headOfRequest = 74;  // of its PDU: version, AE titles, reserved bytes (PS3.8 9.3.2)
constexpr qsizetype headOfItem = 4;

struct PduItem {
  char type;
  QByteArray value;
};

QList<PduItem> itemsFrom(const QByteArray& bytes) {
  QList<PduItem> items;
  for (qsizetype at = 0; at + headOfItem <= bytes.size();) {
    const qsizetype length = qFromBigEndian<quint16>(bytes.constData() + at + 2);
    items << PduItem{bytes[at], bytes.mid(at + headOfItem, length)};
    at += headOfItem + length;
  }
  return items;
}

// Returns the roles that a requestor proposes (PS3.7 D.3.3.4).
QByteArray rolesIn(const QByteArray& request) {
  QByteArray roles;
  for (const PduItem& item : itemsFrom(request.mid(headOfRequest)))
    if (item.type == 0x50)
      for (const PduItem& part : itemsFrom(item.value))
        if (part.type == 0x54) roles += pduItem(part.type, part.value);
  return roles;
}

QByteArray storageCommand(int context, const QByteArray& uid) {
  return commandPdu(context, commandElement(0x0002, UID_CTImageStorage) + commandElement(0x0100, quint16(1)) +
                                 commandElement(0x0110, quint16(9)) + commandElement(0x0700, quint16(0)) +
                                 commandElement(0x0800, quint16(1)) + commandElement(0x1000, uid));
}

}  // namespace

QByteArray pduOf(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + bigEndian(quint32(value.size())) + value;
}

QByteArray pduItem(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + bigEndian(quint16(value.size())) + value;
}

QByteArray proposalOf(int id, const QByteArray& sopClass, const QList<QByteArray>& syntaxes) {
  QByteArray value = QByteArray(1, char(id)) + QByteArray(3, '\0') + pduItem(0x30, sopClass);
  for (const QByteArray& syntax : syntaxes) value += pduItem(0x40, syntax);
  return pduItem(0x20, value);
}

QByteArray associationRequest(const AssociationRequest& request) {
  return pduOf(
      pduRequest,
      bigEndian(quint16(1)) + bigEndian(quint16(0)) + request.called.leftJustified(16) +
          request.calling.leftJustified(16) + QByteArray(32, '\0') + request.name + request.contexts +
          pduItem(0x50, pduItem(0x51, bigEndian(request.mostBytes)) + pduItem(0x52, "1.2.3") + request.more));
}

QByteArray releaseRequest() { return pduOf(pduReleaseRequest, QByteArray(4, '\0')); }

QList<ProposedContext> contextsIn(const QByteArray& request) {
  QList<ProposedContext> contexts;
  for (const PduItem& item : itemsFrom(request.mid(headOfRequest))) {
    if (item.type != 0x20) continue;
    ProposedContext context{quint8(item.value[0]), {}, {}};
    for (const PduItem& part : itemsFrom(item.value.mid(4)))
      part.type == 0x30 ? context.sopClass = part.value : (context.syntaxes << part.value, part.value);
    contexts << context;
  }
  return contexts;
}

QByteArray lastSyntax(const ProposedContext& context) { return context.syntaxes.last(); }

QByteArray acceptanceOf(const QByteArray& request, const ChosenSyntax& chosen) {
  constexpr char noSyntax = 4;  // result (PS3.8 9.3.3.2)
  QByteArray contexts;
  for (const ProposedContext& context : contextsIn(request)) {
    const QByteArray syntax = chosen(context);
    contexts += pduItem(0x21, QByteArray(1, char(context.id)) + '\0' + (syntax.isEmpty() ? noSyntax : '\0') +
                                  '\0' + pduItem(0x40, syntax));
  }
  const QByteArray user =
      pduItem(0x51, bigEndian(quint32(16384))) + pduItem(0x52, "1.2.3") + rolesIn(request);
  return pduOf(pduAcceptance, request.mid(6, headOfRequest - 6) +
                                  pduItem(0x10, UID_StandardApplicationContext) + contexts +
                                  pduItem(0x50, user));
}

QByteArray dataPdu(int context, int control, const QByteArray& fragment) {
  return pduOf(pduData, bigEndian(quint32(fragment.size() + 2)) + char(context) + char(control) + fragment);
}

QByteArray dataPdus(int context, bool isCommand, const QByteArray& bytes) {
  constexpr qsizetype most = 16000;
  QByteArray pdus;
  for (qsizetype at = 0; at == 0 || at < bytes.size(); at += most)
    pdus += dataPdu(context, (isCommand ? 1 : 0) + (at + most >= bytes.size() ? 2 : 0), bytes.mid(at, most));
  return pdus;
}

QByteArray implicitElement(quint16 group, quint16 element, QByteArray value) {
  if (value.size() % 2) value += '\0';
  return littleEndian(group) + littleEndian(element) + littleEndian(quint32(value.size())) + value;
}

QByteArray commandElement(quint16 element, const QByteArray& value) {
  return implicitElement(0, element, value);
}

QByteArray commandElement(quint16 element, quint16 value) {
  return implicitElement(0, element, littleEndian(value));
}

QByteArray commandOf(const QByteArray& elements) {
  return commandElement(0x0000, littleEndian(quint32(elements.size()))) + elements;
}

QByteArray commandPdu(int context, const QByteArray& elements) {
  return dataPdu(context, 3, commandOf(elements));
}

QByteArray valueIn(const QByteArray& bytes, quint16 group, quint16 element) {
  constexpr qsizetype head = 8;
  for (qsizetype at = 0; at + head <= bytes.size();) {
    const qsizetype length = qFromLittleEndian<quint32>(bytes.constData() + at + 4);
    const bool isIt = bytes.mid(at, 4) == littleEndian(group) + littleEndian(element);
    if (isIt) return bytes.mid(at + head, length);
    at += head + length;
  }
  return {};
}

QByteArray echoPdu() {
  return commandPdu(1, commandElement(0x0002, UID_VerificationSOPClass) +
                           commandElement(0x0100, quint16(0x0030)) + commandElement(0x0110, quint16(7)) +
                           commandElement(0x0800, quint16(0x0101)));
}

QByteArray storagePdus(int context) {
  const QByteArray uid = "1.2.3.1.9";
  return storageCommand(context, uid) +
         dataPdu(context, 2,
                 implicitElement(0x0008, 0x0016, UID_CTImageStorage) + implicitElement(0x0008, 0x0018, uid) +
                     implicitElement(0x0020, 0x000d, "1.2.3") + implicitElement(0x0020, 0x000e, "1.2.3.1"));
}

QByteArray begunStorage() { return storageCommand(3, "1.2.3.4") + dataPdu(3, 0, QByteArray(8000, '\0')); }

QByteArray joined(const QByteArray& pdus) {
  constexpr qsizetype head = 6;
  QByteArray values;
  for (qsizetype at = 0; at < pdus.size();) {
    const qsizetype length = qFromBigEndian<quint32>(pdus.constData() + at + 2);
    values += pdus.mid(at + head, length);
    at += head + length;
  }
  return pduOf(pduData, values);
}

QByteArray nestedSequences(int levels) {
  const QByteArray level("\x40\0\x75\x02\xff\xff\xff\xff\xfe\xff\0\xe0\xff\xff\xff\xff", 16);
  return level.repeated(levels);
}

QByteArray deepCommand() { return dataPdus(1, true, nestedSequences(25000)); }

QByteArray endlessPdu() {
  return QByteArray(1, pduData) + '\0' + bigEndian(quint32(0xfffffff0)) + QByteArray(1000, 'x');
}

// The meta information begins with its length.
QByteArray dataSetIn(const QByteArray& file) {
  constexpr qsizetype lengthAt = 140, metaAt = 144;
  if (file.size() < metaAt) return {};
  return file.mid(metaAt + qsizetype(qFromLittleEndian<quint32>(file.constData() + lengthAt)));
}

}  // namespace volumen::tests
