#include "io/archive/move.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <QTemporaryDir>
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <set>
#include <system_error>

#include "io/archive/association.h"
#include "io/archive/data_sets.h"
#include "io/archive/receive_archive.h"

namespace volumen {

namespace {

constexpr const char* moveModel = UID_MOVEStudyRootQueryRetrieveInformationModel;
constexpr std::chrono::milliseconds glance{20};

// Listens while an archive sends, and hands on what was asked for.
class MoveReception {
 public:
  MoveReception(const Listening& listening, const WantedInstances& wanted, InstanceSink& sink)
      : listening_(listening), sink_(sink) {
    for (const ListedInstance& one : wanted.instances) wanted_.insert(one.uid);
  }
  ~MoveReception() { stop(); }

  // The Error: the port or the disk cannot be used.
  Status start() {
    if (!folder_.isValid())
      return Error{"No folder for what comes can be made: " + folder_.errorString().toStdString() + "."};
    ReceiveEvents events;
    events.onListening = [this] { isListening_ = true; };
    events.onStored = [this](const Received& one) { take(one); };
    events.wants = [this](const dicom::InstanceUids& uids) { return wanted_.count(uids.instance) > 0; };
    running_ = std::async(std::launch::async, [this, events] {
      return receiveInstances(listening_, folder_.path().toStdString(), events, end_);
    });
    while (!isListening_)
      if (running_.wait_for(glance) == std::future_status::ready) return running_.get().error();
    return {};
  }

  void stop() {
    end_.cancel();
    if (running_.valid()) running_.wait();
  }

  // Why this computer did not keep all that came.
  const Status& problem() const { return problem_; }

 private:
  void take(const Received& one) {
    const Status kept = keep(one);
    if (!kept && problem_) problem_ = kept;
    std::error_code ignored;
    std::filesystem::remove(one.path, ignored);
  }

  Status keep(const Received& one) {
    if (sink_.has(one.sopInstanceUid)) return {};
    const auto path = sink_.begin();
    if (!path) return path.error();
    std::error_code failed;
    std::filesystem::copy_file(one.path, *path, std::filesystem::copy_options::overwrite_existing, failed);
    if (!failed) return sink_.end({one.studyUid, one.seriesUid, one.sopInstanceUid, "", ""});
    sink_.drop();
    return Error{*path + " cannot be written: " + failed.message() + "."};
  }

  const Listening& listening_;
  InstanceSink& sink_;
  std::set<std::string> wanted_;
  QTemporaryDir folder_;
  std::atomic<bool> isListening_{false};
  Status problem_;
  const CancelToken end_;
  std::future<Result<ReceiveReport>> running_;
};

// Returns whether another program that holds our port receives DICOM: it must answer a C-ECHO soon. If it
// does not, nobody would take the images that the archive sends.
bool isReceiver(const Listening& listening) {
  constexpr std::chrono::seconds patience{3};
  Archive here;
  here.host = listening.address == "0.0.0.0" ? "127.0.0.1" : listening.address;
  here.port = listening.port;
  here.calledAe = listening.ae;
  here.callingAe = listening.peers.empty() ? listening.ae : listening.peers.front();
  const CancelToken end;
  auto asked = std::async(std::launch::async, [&] {
    auto association = Association::open(here, {plainService(UID_VerificationSOPClass)}, end);
    return association && association->echo();
  });
  if (asked.wait_for(patience) != std::future_status::ready) end.cancel();
  return asked.get();
}

Status ask(Association& association, const WantedInstances& wanted, const std::string& destination) {
  std::vector<std::string> uids;
  if (!wanted.isWhole)
    for (const ListedInstance& one : wanted.instances) uids.push_back(one.uid);
  for (DcmDataset& keys : keysForInstances(wanted.studyUid, wanted.seriesUid, uids))
    if (Status s = ended(association.move(moveModel, keys, destination)); !s) return s;
  return {};
}

}  // namespace

Status moveFromArchive(const Archive& archive, const WantedInstances& wanted, InstanceSink& sink,
                       const CancelToken& cancel) try {
  const Listening& listening = *archive.listen;
  auto association = Association::open(archive, {plainService(moveModel)}, cancel);
  if (!association) return association.error();
  MoveReception reception(listening, wanted, sink);
  // Where volumen receives already, what comes is filed in the same place.
  const Status listens = reception.start();
  if (!listens && !isReceiver(listening)) return listens;
  const Status moved = ask(*association, wanted, listening.ae);
  reception.stop();
  const bool isAll =
      std::ranges::all_of(wanted.instances, [&](const ListedInstance& one) { return sink.has(one.uid); });
  if (isAll) return {};
  if (!listens) return listens;
  if (!reception.problem()) return reception.problem();
  return Error{(moved ? "The archive \"" + archive.name + "\" did not send all." : moved.message()) +
               " It must know the AE title " + listening.ae + " at this machine's address, port " +
               std::to_string(listening.port) + "."};
} catch (const std::system_error&) {
  return Error{"The system starts no more threads, of which one would receive what the archive sends."};
}

}  // namespace volumen
