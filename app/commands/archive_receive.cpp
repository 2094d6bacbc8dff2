#include "app/commands/archive_receive.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/index_option.h"
#include "io/archive/receive_into_index.h"

namespace volumen {

namespace {

std::string images(int count) { return std::to_string(count) + (count == 1 ? " image" : " images"); }

// Returns what an association brought: "STORESCU (127.0.0.1): 3 images received; 1 image refused; ...".
std::string lineOf(const ReceivedAssociation& one) {
  std::string parts;
  const auto add = [&](bool is, const std::string& part) {
    if (is) parts += (parts.empty() ? "" : "; ") + part;
  };
  add(one.stored > 0, images(one.stored) + " received");
  add(one.alreadyHere > 0, images(one.alreadyHere) + " here already");
  add(one.refused > 0, images(one.refused) + " refused");
  add(one.isVerified, "verified that volumen answers");
  add(!one.problem.empty(), one.problem);
  add(parts.empty(), "sent nothing");
  return one.callingAe + " (" + one.address + "): " + parts + (parts.ends_with('.') ? "" : ".");
}

std::string jsonLine(const Received& one) {
  const nlohmann::ordered_json json{
      {"studyUid", one.studyUid},      {"seriesUid", one.seriesUid}, {"sopInstanceUid", one.sopInstanceUid},
      {"path", pathForJson(one.path)}, {"bytes", one.bytes},         {"alreadyHere", one.alreadyHere},
      {"callingAe", one.callingAe}};
  return printableJson(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

ReceiveEvents eventsFor(const Listening& listening, bool json) {
  ReceiveEvents events;
  events.onListening = [&listening] {
    const bool isIpv6 = listening.address.find(':') != std::string::npos;
    std::cerr << "Listening at " << (isIpv6 ? "[" + listening.address + "]" : listening.address) << ':'
              << listening.port << " as " << listening.ae << ". Ctrl-C ends.\n";
  };
  events.onStored = [json](const Received& one) {
    if (json) std::cout << jsonLine(one) << std::endl;
  };
  events.onEnded = [json](const ReceivedAssociation& one) {
    if (!json)
      std::cout << printable(lineOf(one)) << std::endl;
    else if (!one.problem.empty())
      std::cerr << "volumen: " << printable(lineOf(one)) << '\n';
  };
  return events;
}

Result<ReceiveReport> receive(const Listening& listening, const ReceiveOptions& options,
                              const CancelToken& cancel) {
  const ReceiveEvents events = eventsFor(listening, options.json);
  if (!options.folder.empty()) return receiveInstances(listening, options.folder, events, cancel);
  const auto onImported = [](const Result<ImportReport>& imported) {
    if (!imported) fail(imported.message());
  };
  return receiveIntoIndex(listening, indexFolderOr(options.index), events, onImported, cancel);
}

}  // namespace

int receiveFromPeers(const Archives& archives, const ReceiveOptions& options, const CancelToken& cancel) {
  if (!archives.listen)
    return fail(options.list +
                " does not say where to listen: add \"listen\": {\"ae\": \"VOLUMEN\", \"port\": 11112} to it "
                "(man volumen, ARCHIVES).");
  const auto report = receive(*archives.listen, options, cancel);
  return report ? exitDone : fail(report.message());
}

}  // namespace volumen
