#include "io/deidentify/pseudonyms.h"

#include <QMessageAuthenticationCode>
#include <QRandomGenerator>
#include <algorithm>
#include <array>
#include <filesystem>

#include "io/export/dicom_uid.h"
#include "io/files/output_file.h"
#include "io/files/preset_files.h"
#include "io/files/private_folder.h"
#include "io/regular_file.h"

namespace volumen {

namespace {

constexpr std::size_t keyBytes = 32, leastKeyBytes = 16, mostKeyBytes = 4096;

QByteArray keyedHash(const std::string& key, const char* kind, const std::string& text) {
  return QMessageAuthenticationCode::hash(QByteArray(kind) + QByteArray::fromStdString(text),
                                          QByteArray::fromStdString(key), QCryptographicHash::Sha256);
}

std::string randomKey() {
  std::array<quint32, keyBytes / sizeof(quint32)> words;
  QRandomGenerator::system()->fillRange(words.data(), qsizetype(words.size()));
  return QByteArray(reinterpret_cast<const char*>(words.data()), qsizetype(keyBytes)).toHex().toStdString();
}

}  // namespace

std::string Pseudonyms::uid(const std::string& old) const {
  if (old.empty() || old.starts_with("1.2.840.10008.")) return old;
  const QByteArray hash = keyedHash(key_, faceless_ ? "faceless uid:" : "uid:", old);
  std::array<std::uint8_t, 16> uuid;
  std::copy_n(hash.cbegin(), uuid.size(), uuid.begin());
  return uidOfUuid(uuid);
}

std::string Pseudonyms::name(const std::string& old) const {
  constexpr int letters = 10;
  return keyedHash(key_, "name:", old).toHex().left(letters).toUpper().toStdString();
}

Result<std::string> pseudonymKeyIn(const std::string& path) {
  Result<std::string> key = wholeText(path, mostKeyBytes, "a key");
  if (key && key->size() < leastKeyBytes)
    return Error{path + " is too short for a key: it needs 16 bytes or more."};
  return key;
}

std::string userPseudonymKeyFile() { return configFolder() + "/deidentification.key"; }

Result<std::string> userPseudonymKey() {
  const std::string path = userPseudonymKeyFile();
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return pseudonymKeyIn(path);
  if (Status made = makePrivateFolder(configFolder()); !made) return made.error();
  const std::string key = randomKey();
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  using std::filesystem::perms;
  std::filesystem::permissions(file->asidePath(), perms::owner_read | perms::owner_write, ignored);
  if (Status written = file->write(key); !written) return written.error();
  if (Status kept = file->commit(); !kept) return kept.error();
  return key;
}

}  // namespace volumen
