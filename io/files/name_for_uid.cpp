#include "io/files/name_for_uid.h"

#include <QByteArray>
#include <QCryptographicHash>

namespace volumen {

std::string nameForUid(const std::string& uid) {
  const QByteArray hash =
      QCryptographicHash::hash(QByteArray::fromStdString(uid), QCryptographicHash::Sha256);
  return hash.toHex().left(32).toStdString();
}

}  // namespace volumen
