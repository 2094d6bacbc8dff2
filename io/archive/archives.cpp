#include "io/archive/archives.h"

#include <arpa/inet.h>

#include <QUrl>
#include <algorithm>
#include <filesystem>

#include "io/files/preset_files.h"
#include "io/regular_file.h"
#include "viewer/scene/fields.h"

namespace volumen {

namespace {

constexpr std::uint64_t mostBytesOfList = 1 << 20;
const Words<ArchiveKind> kinds{{"dimse", ArchiveKind::dimse}, {"dicomweb", ArchiveKind::dicomweb}};

void aeTitle(Fields& f, const char* name, std::string& title) {
  f(name, title);
  const std::string problem = problemOfAeTitle(title);
  f.require(name, problem.empty(), problem);
}

// "name:STUDY/SERIES" names a study of an archive.
bool isName(const std::string& name) {
  return !name.empty() && name.size() <= 64 && name.find_first_of(":/") == std::string::npos;
}

// DCMTK has room for 63 characters with the port, and none for colons.
bool isHost(const std::string& host) {
  return !host.empty() && host.size() <= 56 &&
         std::ranges::all_of(host, [](char c) { return c > ' ' && c <= '~' && c != ':' && c != '/'; });
}

bool isUrl(const std::string& text) {
  const QUrl url(QString::fromStdString(text), QUrl::StrictMode);
  return url.isValid() && (url.scheme() == u"http" || url.scheme() == u"https") && !url.host().isEmpty() &&
         url.userInfo().isEmpty() && !url.hasQuery() && !url.hasFragment();
}

bool isIpAddress(const std::string& address) {
  in6_addr parsed{};  // has room for both
  return inet_pton(AF_INET, address.c_str(), &parsed) == 1 ||
         inet_pton(AF_INET6, address.c_str(), &parsed) == 1;
}

}  // namespace

static void fields(Fields& f, TlsSettings& tls) {
  f.unless({}, "pin", tls.pin);
  f.unless({}, "ca", tls.ca);
  f.unless({}, "certificate", tls.certificate);
  f.unless({}, "key", tls.key);
  f.require("pin",
            tls.pin.empty() || (tls.pin.size() == 64 &&
                                tls.pin.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos),
            "must have 64 hexadecimal digits, the SHA-256 of the archive's certificate");
  f.require("key", tls.key.empty() == tls.certificate.empty(), "and \"certificate\" belong together");
}

static void dimseFields(Fields& f, Archive& archive) {
  f.needed("host", archive.host);
  f.require("host", isHost(archive.host),
            "must be a name or an address of up to 56 characters, without a port");
  f("port", archive.port, {1, 65535});
  f.require("calledAe", !f.reading() || f.raw("calledAe"), "is missing");
  aeTitle(f, "calledAe", archive.calledAe);
  aeTitle(f, "callingAe", archive.callingAe);
  f.unless({}, "characterSet", archive.characterSet);
  f.require("tls", !archive.tls || !archive.tls->pin.empty() || !archive.tls->ca.empty(),
            "must say by \"pin\" or \"ca\" which certificate the archive has");
}

static void webFields(Fields& f, Archive& archive) {
  f.needed("url", archive.url);
  f.require("url", isUrl(archive.url),
            "must begin with http:// or https:// and hold neither user, \"?\" nor \"#\"");
  while (archive.url.ends_with('/')) archive.url.pop_back();
  f.unless({}, "user", archive.user);
  f.unless({}, "passwordCommand", archive.passwordCommand);
  f.unless({}, "tokenCommand", archive.tokenCommand);
  f.require("user", archive.user.empty() == archive.passwordCommand.empty(),
            "and \"passwordCommand\" belong together");
  f.require("user", archive.user.find(':') == std::string::npos, "must not hold \":\"");
  f.require("tokenCommand", archive.tokenCommand.empty() || archive.user.empty(),
            "and \"user\" exclude each other");
  f.require("tls", !archive.tls || archive.url.starts_with("https:"), "needs a URL with https://");
}

static void fields(Fields& f, Archive& archive) {
  f.needed("name", archive.name);
  f.require("name", isName(archive.name), "must be 1 to 64 characters without \":\" and \"/\"");
  f.needed("kind", archive.kind, kinds);
  f.unlessNone("tls", archive.tls);
  archive.kind == ArchiveKind::dimse ? dimseFields(f, archive) : webFields(f, archive);
}

static void fields(Fields& f, Listening& listen) {
  constexpr int mostPeers = 1000;
  aeTitle(f, "ae", listen.ae);
  f("port", listen.port, {1, 65535});
  f("address", listen.address);
  f.require("address", isIpAddress(listen.address),
            "must be an IP address of this machine, or 0.0.0.0 or :: for all of them");
  f.texts("peers", listen.peers, mostPeers, "must be a list of up to 1000 AE titles");
  for (std::size_t n = 0; n < listen.peers.size(); ++n)
    if (const std::string problem = problemOfAeTitle(listen.peers[n]); !problem.empty())
      f.refuse(f.pathOf("peers", n), problem);
  f("mostAssociations", listen.mostAssociations, {1, 1000});
  f("mostMegabytes", listen.mostMegabytes, {1, 1'000'000});
  f.unlessNone("tls", listen.tls);
  f.require("tls", !listen.tls || (!listen.tls->certificate.empty() && listen.tls->pin.empty()),
            "must name our \"certificate\" and its \"key\", and may name the \"ca\" of peers");
}

static void fields(Fields& f, Archives& all) {
  f("archives", all.archives);
  f.unlessNone("listen", all.listen);
  if (f.reading() || all.keepGb != Archives().keepGb) f("keepGb", all.keepGb, {0, 1'000'000});
  for (std::size_t n = 0; n < all.archives.size(); ++n) {
    const auto same = [&](const Archive& a) { return a.name == all.archives[n].name; };
    if (std::count_if(all.archives.begin(), all.archives.end(), same) > 1)
      f.refuse(f.pathOf("archives", n) + ".name",
               "is used twice: " + JsonFields::quoted(all.archives[n].name));
  }
}

std::string addressOf(const Archive& archive) {
  return archive.kind == ArchiveKind::dicomweb ? archive.url
                                               : archive.host + ":" + std::to_string(archive.port);
}

std::string problemOfAeTitle(const std::string& title) {
  if (title.find_first_not_of(' ') == std::string::npos) return "must be an AE title, not empty";
  if (title.size() > 16) return "must have at most 16 characters";
  const bool plain = std::ranges::all_of(title, [](char c) { return c >= ' ' && c <= '~' && c != '\\'; });
  return plain ? "" : "must be printable ASCII without backslash";
}

Result<Archives> parseArchives(const std::string& json) {
  const auto parsed = parseJson(json, 1);
  if (!parsed) return parsed.error();
  std::string problem;
  Fields f(JsonFields(*parsed, "", problem));
  Archives archives;
  fields(f, archives);
  f.refuseOthers();
  if (!problem.empty()) return Error{problem};
  for (Archive& archive : archives.archives)
    archive.listen = archives.listen, archive.keepGb = archives.keepGb;
  return archives;
}

std::uint64_t mostBytesFetched(const Archive& archive) {
  return std::uint64_t(archive.keepGb) * 1'000'000'000;
}

std::string archivesToJson(const Archives& archives) {
  return jsonOf(archives).dump(1, ' ', false, JsonFields::Json::error_handler_t::replace) + "\n";
}

std::string userArchivesFile() { return configFolder() + "/archives.json"; }

Result<Archives> readArchives(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return Archives{};
  const auto text = wholeText(path, mostBytesOfList, "a list of archives");
  if (!text) return text.error();
  auto archives = parseArchives(*text);
  if (!archives) return Error{path + ": " + archives.message()};
  return archives;
}

std::string noArchives(const std::string& path) {
  return "No archive is set up: add one to " + path +
         " (man volumen, ARCHIVES). To try one here: apt install orthanc "
         "(resources/docs/archives.md).";
}

Result<Archive> archiveNamed(const Archives& archives, const std::string& name, const std::string& path) {
  std::string names;
  for (const Archive& archive : archives.archives) {
    if (archive.name == name) return archive;
    names += (names.empty() ? "" : ", ") + JsonFields::quoted(archive.name);
  }
  if (names.empty()) return Error{noArchives(path)};
  return Error{"There is no archive " + JsonFields::quoted(name) + ": " + path + " lists " + names + "."};
}

}  // namespace volumen
