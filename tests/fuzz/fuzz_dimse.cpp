// Fuzzes what peers send by DIMSE. The first byte of an input says which of our sides they talk to, the
// others are what they send, and then they close the connection.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/dul.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "io/archive/association.h"
#include "io/archive/data_sets.h"
#include "io/archive/incoming_association.h"
#include "io/archive/instance_folder.h"
#include "io/archive/network_use.h"

using namespace volumen;

namespace {

using Bytes = std::vector<std::uint8_t>;

const std::string folder = "/dev/shm/volumen-fuzz-dimse-" + std::to_string(getpid());

std::size_t bigEndian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t n = 0; n < count; ++n) value = value << 8 | bytes[at + n];
  return value;
}

void shorten(Bytes& bytes, std::size_t at, std::size_t most) {
  if (bigEndian(bytes, at, 4) <= most) return;
  for (std::size_t n = 0; n < 4; ++n) bytes[at + n] = std::uint8_t(most >> (24 - 8 * n));
}

// Shortens PDUs, and values in them, that claim to be longer than what there is: what follows would not be
// read.
void mend(Bytes& pdus) {
  constexpr std::size_t head = 6, valueHead = 4;
  constexpr std::uint8_t dataPdu = 4;
  for (std::size_t at = 0; at + head <= pdus.size();) {
    shorten(pdus, at + 2, pdus.size() - at - head);
    const std::size_t end = at + head + bigEndian(pdus, at + 2, 4);
    for (std::size_t value = at + head; pdus[at] == dataPdu && value + valueHead <= end;) {
      shorten(pdus, value, end - value - valueHead);
      value += valueHead + bigEndian(pdus, value, 4);
    }
    at = end;
  }
}

// Sends all, and takes what comes until the other side ends, too.
void talk(int socket, const Bytes& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t some = ::send(socket, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
    if (some <= 0) break;
    at += std::size_t(some);
  }
  ::shutdown(socket, SHUT_WR);
  char answer[4096];
  while (::recv(socket, answer, sizeof answer, 0) > 0) continue;
  ::close(socket);
}

void sendToListener(const Bytes& bytes) {
  static const Listening listening{.mostMegabytes = 1};
  Reception reception{listening, {}, {}, ReceivedFiles(folder, {})};
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) std::abort();
  std::thread peer([&] { talk(ends[0], bytes); });
  const auto received = serveConnection(reception, ends[1], "peer");
  peer.join();
  if (received && received->stored > 0)
    std::filesystem::remove_all(folder), std::filesystem::create_directory(folder);
}

// A socket at a port of this machine, which it sets.
int listeningSocket(Archive& archive) {
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  if (::bind(socket, reinterpret_cast<sockaddr*>(&at), size) != 0 || ::listen(socket, 1) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size) != 0)
    std::abort();
  archive.port = ntohs(at.sin_port);
  return socket;
}

void ask(Association& association, int what) {
  constexpr const char* study = "1.2.3";
  DcmDataset keys = keysAt("STUDY", study);
  askFor(keys, {DCM_PatientName, DCM_StudyInstanceUID});
  if (what == 0) (void)association.echo().ok();
  if (what == 1)
    (void)association
        .find(UID_FINDStudyRootQueryRetrieveInformationModel, keys,
              [](DcmDataset& data) {
                const Answer answer(data, "");
                return answer.text(DCM_PatientName) != "STOP" && answer.text(DCM_StudyInstanceUID) != "";
              })
        .ok();
  if (what == 2) {
    InstanceFolder sink("fuzz", folder, study, "1.2.3.1", 10);
    (void)association.get(UID_GETStudyRootQueryRetrieveInformationModel, keys, sink).ok();
  }
  if (what == 3) (void)association.move(UID_MOVEStudyRootQueryRetrieveInformationModel, keys, "ME").ok();
}

void answerUs(const Bytes& bytes, int what) {
  static Archive archive{.name = "a", .host = "127.0.0.1", .calledAe = "A"};
  static const int socket = listeningSocket(archive);
  std::thread peer([&] { talk(::accept(socket, nullptr, nullptr), bytes); });
  std::vector<WantedService> services;
  for (const char* one :
       {UID_VerificationSOPClass, UID_FINDStudyRootQueryRetrieveInformationModel,
        UID_GETStudyRootQueryRetrieveInformationModel, UID_MOVEStudyRootQueryRetrieveInformationModel})
    services.push_back(plainService(one));
  services.push_back({UID_CTImageStorage, {UID_LittleEndianExplicitTransferSyntax}, true});
  {
    auto association = Association::open(archive, services, {});
    if (association) ask(*association, what);
  }
  peer.join();
}

struct Setup {
  Setup() {
    dcmDisableGethostbyaddr.set(OFTrue);
    std::filesystem::create_directory(folder);
  }
  ~Setup() { std::filesystem::remove_all(folder); }
  NetworkUse use;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Setup setup;
  if (size < 2) return 0;
  constexpr int sides = 8, archiveSides = 4;
  const int side = bytes[0] % sides;
  Bytes sent(bytes + 1, bytes + size);
  if (bytes[0] >= 2 * sides) mend(sent);
  side < archiveSides ? answerUs(sent, side) : sendToListener(sent);
  return 0;
}
