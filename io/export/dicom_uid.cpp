#include "io/export/dicom_uid.h"

#include <QByteArrayView>
#include <QCryptographicHash>
#include <QUuid>
#include <algorithm>

namespace volumen {

namespace {

std::string uidOf(const QUuid& uuid) {
  const QByteArray bytes = uuid.toRfc4122();
  std::array<std::uint8_t, 16> array;
  std::copy_n(bytes.cbegin(), array.size(), array.begin());
  return uidOfUuid(array);
}

}  // namespace

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
  return uidOf(QUuid::createUuidV5(QUuid::fromRfc4122(space), QByteArray::fromStdString(what)));
}

std::string randomUid() { return uidOf(QUuid::createUuid()); }

std::string uidOfUuid(std::array<std::uint8_t, 16> uuid) {
  std::string digits;
  while (std::ranges::any_of(uuid, [](std::uint8_t byte) { return byte != 0; })) {
    int rest = 0;
    for (std::uint8_t& byte : uuid) {
      const int value = rest * 256 + byte;
      byte = std::uint8_t(value / 10);
      rest = value % 10;
    }
    digits.insert(digits.begin(), char('0' + rest));
  }
  return "2.25." + digits;
}

}  // namespace volumen
