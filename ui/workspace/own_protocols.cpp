#include "ui/workspace/own_protocols.h"

#include <QDir>
#include <QFile>
#include <algorithm>

#include "io/files/preset_files.h"

namespace volumen {

namespace {

// A protocol already known by this name hides the new one.
void addProtocol(KnownProtocols& known, const std::string& path, const std::string& text) {
  Result<HangingProtocol> protocol = protocolFromJson(text);
  if (!protocol) return known.problems.push_back(path + ": " + protocol.message());
  const auto& all = known.protocols;
  if (std::ranges::find(all, protocol->name, &HangingProtocol::name) == all.end())
    known.protocols.push_back(std::move(*protocol));
}

}  // namespace

KnownProtocols knownProtocols() {
  KnownProtocols known;
  for (const PresetFile& file : readPresetFiles(protocolFolder())) addProtocol(known, file.path, file.text);
  known.own = known.protocols.size();
  const QDir folder(QStringLiteral(":/protocols"));
  for (const QString& name : folder.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
    QFile file(folder.filePath(name));
    if (file.open(QIODevice::ReadOnly)) addProtocol(known, name.toStdString(), file.readAll().toStdString());
  }
  return known;
}

Status saveOwnProtocol(const HangingProtocol& protocol) {
  const KnownProtocols known = knownProtocols();
  const auto builtIn = known.protocols.begin() + std::ptrdiff_t(known.own);
  if (std::find_if(builtIn, known.protocols.end(), [&](const HangingProtocol& p) {
        return p.name == protocol.name;
      }) != known.protocols.end())
    return Error{"\"" + protocol.name + "\" is a protocol of the program; choose another name."};
  return writePresetFile(protocol.name, protocolToJson(protocol), protocolFolder());
}

}  // namespace volumen
