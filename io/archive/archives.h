#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// The protocol of an archive.
enum class ArchiveKind { dimse, dicomweb };

/// Files and pin for TLS. Empty texts are not given. Without pin and `ca`, the machine's authorities count.
struct TlsSettings {
  std::string pin;               ///< SHA-256 of the archive's certificate, 64 hexadecimal digits
  std::string ca;                ///< file of accepted authorities or certificates, PEM
  std::string certificate, key;  ///< files of our certificate and its key, PEM
  bool operator==(const TlsSettings&) const = default;
};

/// Where and from whom this program takes instances that peers send (Storage SCP).
struct Listening {
  std::string ae = "VOLUMEN";  ///< our AE title; associations that call another one are rejected
  int port = 11112;
  std::string address = "127.0.0.1";  ///< of this machine, IPv4 or IPv6; 0.0.0.0: all of IPv4, "::": all
  std::vector<std::string> peers;     ///< AE titles that may send; empty: everyone
  int mostAssociations = 16;          ///< open at once
  int mostMegabytes = 4096;           ///< largest instance, millions of bytes
  std::optional<TlsSettings> tls{};   ///< peers must encrypt; with `ca`, they must show a certificate of it
  bool operator==(const Listening&) const = default;
};

/// An archive of studies beside this machine (PACS). `name` is how a user calls it.
struct Archive {
  std::string name;
  ArchiveKind kind = ArchiveKind::dimse;
  std::optional<TlsSettings> tls;
  // DIMSE
  std::string host;
  int port = 104;
  std::string calledAe, callingAe = "VOLUMEN";  ///< AE titles of the archive and of this program
  std::string characterSet;           ///< of answers that name none: a defined term of PS3.3 C.12.1.1.2
  std::optional<Listening> listen{};  ///< that of the list: where it can send to (C-MOVE)
  // DICOMweb
  std::string url;  ///< of its services, without a slash at the end: "https://HOST/dicom-web"
  std::string user, passwordCommand;  ///< basic authentication; the command prints the password
  std::string tokenCommand;           ///< prints a bearer token
  int keepGb = 20;                    ///< that of the list
  bool operator==(const Archive&) const = default;
};

struct Archives {
  std::vector<Archive> archives;
  std::optional<Listening> listen{};  ///< empty: volumen does not listen
  int keepGb =
      20;  ///< fetched studies beyond so many GB are removed, those unused longest first; 0: none are
  bool operator==(const Archives&) const = default;
};

/// Returns where an archive is: "host:port" or its URL.
std::string addressOf(const Archive& archive);

/// Returns how many bytes of fetched studies are kept (trimFetched()); 0: all.
std::uint64_t mostBytesFetched(const Archive& archive);

/// Returns why a text is no AE title of ours, as the end of a sentence; empty if it is one: 1 to 16 printable
/// characters of ASCII without backslash, not blanks only (PS3.5 6.2).
std::string problemOfAeTitle(const std::string& title);

/// Parses a file of archives. The Error names the field.
Result<Archives> parseArchives(const std::string& json);
std::string archivesToJson(const Archives& archives);

/// Returns the path of the user's list, archives.json among the user's settings.
std::string userArchivesFile();

/// Reads a file of archives. A missing one holds none.
Result<Archives> readArchives(const std::string& path);

/// Returns a sentence on a file without archives.
std::string noArchives(const std::string& path);

/// Returns the archive of this name. The Error says which there are.
Result<Archive> archiveNamed(const Archives& archives, const std::string& name, const std::string& path);

}  // namespace volumen
