#include "tests/unit/deidentify/exported.h"

#include <QDirIterator>
#include <QFile>
#include <QMessageAuthenticationCode>

namespace volumen::tests {

namespace {
constexpr const char* testKey = "a key that only these tests use";
}

std::unique_ptr<DcmFileFormat> readWithDcmtk(const QString& path) {
  auto file = std::make_unique<DcmFileFormat>();
  return file->loadFile(QFile::encodeName(path).constData()).good() ? std::move(file) : nullptr;
}

std::string textOf(DcmItem& item, const DcmTagKey& tag) {
  OFString value;
  item.findAndGetOFStringArray(tag, value);
  return std::string(value.c_str(), value.size());
}

QStringList copiesIn(const QString& folder) {
  QStringList files;
  for (QDirIterator all(folder, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories); all.hasNext();)
    files << all.next();
  files.sort();
  return files;
}

void forAllElements(DcmItem& item, const std::function<void(DcmElement&)>& visit) {
  for (unsigned long n = 0; n < item.card(); ++n) {
    DcmElement* const element = item.getElement(n);
    visit(*element);
    if (element->ident() != EVR_SQ) continue;
    auto* const sequence = static_cast<DcmSequenceOfItems*>(element);
    for (unsigned long k = 0; k < sequence->card(); ++k) forAllElements(*sequence->getItem(k), visit);
  }
}

Exported::Exported() {
  QFile key(pathOf("key"));
  if (key.open(QIODevice::WriteOnly)) key.write(testKey);
}

Outcome Exported::run(const QString& path, const QStringList& options) {
  folder_ = dir_.filePath(QStringLiteral("out-%1").arg(++runs_));
  return runProgram(QStringList{QStringLiteral("export"), path, QStringLiteral("--deidentify"),
                                QStringLiteral("-o"), folder_, QStringLiteral("--key"), pathOf("key")} +
                    options);
}

std::unique_ptr<DcmFileFormat> Exported::only() const {
  const QStringList files = copiesIn(folder_);
  return files.size() == 1 ? readWithDcmtk(files.front()) : nullptr;
}

std::string Exported::uid(const std::string& old) const {
  if (old.empty() || old.starts_with("1.2.840.10008.")) return old;
  const QByteArray hash = QMessageAuthenticationCode::hash("uid:" + QByteArray::fromStdString(old), testKey,
                                                           QCryptographicHash::Sha256);
  // Long division of the first 16 bytes, from the last decimal digit on.
  std::vector<int> bits;
  for (int n = 0; n < 16; ++n) bits.push_back(std::uint8_t(hash[n]));
  std::string digits;
  for (bool isLeft = true; isLeft;) {
    int rest = 0;
    isLeft = false;
    for (int& byte : bits) {
      rest = rest * 256 + byte;
      byte = rest / 10;
      rest %= 10;
      isLeft = isLeft || byte > 0;
    }
    digits = char('0' + rest) + digits;
  }
  return "2.25." + digits;
}

}  // namespace volumen::tests
