#include "io/export/dicom_uid.h"

#include <QByteArrayView>
#include <QCryptographicHash>
#include <QUuid>
#include <algorithm>

namespace volumen {

DicomUids::DicomUids(const Volume& volume, const std::string& salt) : contents_{} {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  const auto add = [&](const auto& value) {
    hash.addData(QByteArrayView(reinterpret_cast<const char*>(&value), sizeof value));
  };
  const VoxelGeometry& g = volume.geometry();
  add(g.size);
  add(g.patientFromVoxelStep);
  add(g.origin);
  add(volume.slope());
  add(volume.intercept());
  std::visit(
      [&](const auto& values) {
        hash.addData(QByteArrayView(reinterpret_cast<const char*>(values.data()),
                                    qsizetype(values.size() * sizeof(values[0]))));
      },
      volume.stored());
  hash.addData(QByteArrayView(salt.data(), qsizetype(salt.size())));
  std::copy_n(hash.result().cbegin(), contents_.size(), contents_.begin());
}

DicomUids::DicomUids(std::span<const std::uint8_t> contents, const std::string& salt) : contents_{} {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  hash.addData(QByteArrayView(contents.data(), qsizetype(contents.size())));
  hash.addData(QByteArrayView(salt.data(), qsizetype(salt.size())));
  std::copy_n(hash.result().cbegin(), contents_.size(), contents_.begin());
}

std::string DicomUids::of(const std::string& what) const {
  const QByteArray space(reinterpret_cast<const char*>(contents_.data()), qsizetype(contents_.size()));
  QByteArray bytes =
      QUuid::createUuidV5(QUuid::fromRfc4122(space), QByteArray::fromStdString(what)).toRfc4122();
  // Converts the 128 bits to one decimal number.
  std::string digits;
  while (std::any_of(bytes.cbegin(), bytes.cend(), [](char c) { return c != 0; })) {
    int rest = 0;
    for (char& byte : bytes) {
      const int value = rest * 256 + std::uint8_t(byte);
      byte = char(value / 10);
      rest = value % 10;
    }
    digits.insert(digits.begin(), char('0' + rest));
  }
  return "2.25." + digits;
}

}  // namespace volumen
