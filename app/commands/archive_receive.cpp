#include "app/commands/archive_receive.h"

#include <chrono>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/command.h"
#include "app/index_option.h"
#include "io/archive/receive_archive.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

// The folders of studies that are not in the index yet.
class Arrivals {
 public:
  void note(const std::string& studyFolder) {
    const std::scoped_lock one(mutex_);
    last_[studyFolder] = Clock::now();
  }
  // Returns those whose last instance came `quiet` ago or earlier, and forgets them.
  std::vector<std::string> take(Clock::duration quiet) {
    const std::scoped_lock one(mutex_);
    std::vector<std::string> folders;
    std::erase_if(last_, [&, latest = Clock::now() - quiet](const auto& arrival) {
      if (arrival.second > latest) return false;
      folders.push_back(arrival.first);
      return true;
    });
    return folders;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, Clock::time_point> last_;
};

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

ReceiveEvents eventsFor(const Listening& listening, bool json, Arrivals& arrivals) {
  ReceiveEvents events;
  events.onListening = [&listening] {
    std::cerr << "Listening at " << listening.address << ':' << listening.port << " as " << listening.ae
              << ". Ctrl-C ends.\n";
  };
  events.onStored = [json, &arrivals](const Received& one) {
    arrivals.note(one.studyFolder);
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

void addArrivals(std::optional<Index>& index, const std::vector<std::string>& folders) {
  if (!index || folders.empty()) return;
  if (const auto imported = index->import(folders); !imported) fail(imported.message());
}

}  // namespace

int receiveFromPeers(const Archives& archives, const ReceiveOptions& options, const CancelToken& cancel) {
  constexpr std::chrono::milliseconds glance{250};
  constexpr std::chrono::seconds quiet{2};
  if (!archives.listen)
    return fail(options.list +
                " does not say where to listen: add \"listen\": {\"ae\": \"VOLUMEN\", \"port\": 11112} to it "
                "(man volumen, ARCHIVES).");
  std::optional<Index> index;
  if (options.folder.empty()) {
    Result<Index> opened = openIndex(options.index);
    if (!opened) return fail(opened.message());
    index.emplace(std::move(*opened));
  }
  const std::string folder = options.folder.empty() ? fetchedFolder(indexFolderOr(options.index)) : options.folder;
  Arrivals arrivals;
  const ReceiveEvents events = eventsFor(*archives.listen, options.json, arrivals);
  // The index belongs to this thread, so another one listens.
  auto receiving = std::async(std::launch::async,
                              [&] { return receiveInstances(*archives.listen, folder, events, cancel); });
  while (receiving.wait_for(glance) != std::future_status::ready) addArrivals(index, arrivals.take(quiet));
  addArrivals(index, arrivals.take({}));
  const auto report = receiving.get();
  return report ? exitDone : fail(report.message());
}

}  // namespace volumen
