#include "io/archive/send_dimse.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <system_error>
#include <thread>

#include "io/archive/association.h"

namespace volumen {

namespace {

// Peers that wait for 40 ms before each answer (Nagle) are as quick over several associations.
constexpr std::size_t mostAssociations = 4, instancesForEach = 8;
constexpr std::size_t mostServices = 128;
constexpr int mostFailures = 3;

// The services for instances: of each class, plain data and each compressed syntax alone.
class Services {
 public:
  // Returns false if there is no room for those of this instance.
  bool add(const dicom::InstanceUids& uids) {
    std::set<std::string>& syntaxes = ofClass_[uids.sopClass];
    if (syntaxes.empty()) ++count_;
    if (syntaxes.insert(uids.transferSyntax).second) ++count_;
    return count_ <= mostServices;
  }

  std::vector<WantedService> list() const {
    std::vector<WantedService> all;
    for (const auto& [sopClass, syntaxes] : ofClass_) {
      for (const std::string& syntax : syntaxes)
        if (!syntax.empty()) all.push_back({sopClass, {syntax}});
      all.push_back(plainService(sopClass));
    }
    return all;
  }

 private:
  std::map<std::string, std::set<std::string>> ofClass_;
  std::size_t count_ = 0;
};

// Sends a range of instances that share their services.
class Sending {
 public:
  Sending(const Archive& archive, const std::vector<SentInstance>& instances, std::size_t first,
          std::size_t end, const OnSent& onSent, const CancelToken& cancel)
      : archive_(archive), instances_(instances), next_(first), end_(end), onSent_(onSent), cancel_(cancel) {
    Services services;
    for (std::size_t n = first; n < end; ++n) services.add(instances[n].uids);
    services_ = services.list();
  }

  Status operator()() {
    const std::size_t count = end_ - next_;
    const std::size_t lines = std::clamp(count / instancesForEach, std::size_t(1), mostAssociations);
    isAlone_ = lines == 1;
    std::vector<std::thread> threads;
    try {
      for (std::size_t n = 1; n < lines; ++n) threads.emplace_back([this] { sendOverOne(); });
    } catch (const std::system_error&) {
      // The system starts no more threads: those that it started send all.
    }
    sendOverOne();
    for (std::thread& thread : threads) thread.join();
    if (problem_) sendAgain();
    return problem_;
  }

 private:
  void sendOverOne() {
    try {
      sendOverOneWithMemory();
    } catch (const std::bad_alloc&) {
      const std::lock_guard lock(mutex_);
      if (problem_) problem_ = Error{"There is too little memory to send more."};
      next_ = std::max(next_.load(), end_);
    }
  }

  void sendOverOneWithMemory() {
    std::optional<Association> association;
    for (std::size_t n = next_++; n < end_; n = next_++) {
      auto done = sendOne(association, n);
      // A connection that broke is made anew, once for each instance.
      if (!done && !cancel_.cancelled()) done = sendOne(association, n);
      const std::lock_guard lock(mutex_);
      failures_ = done ? 0 : failures_ + 1;
      const bool isKept = done && done->empty();
      if (!done && (cancel_.cancelled() || failures_ == mostFailures)) {
        if (problem_) problem_ = done.error();
        next_ = std::max(next_.load(), end_);
        return;
      }
      if (isKept || isAlone_)
        onSent_(n, done ? *done : done.message());
      else
        again_.push_back(n);
    }
  }

  // Some archives cannot store over several associations at once: what they refuse so is sent once more.
  void sendAgain() {
    std::optional<Association> association;
    failures_ = 0;
    for (const std::size_t n : again_) {
      const auto done = sendOne(association, n);
      failures_ = done ? 0 : failures_ + 1;
      onSent_(n, done ? *done : done.message());
      if (cancel_.cancelled() || failures_ == mostFailures) return;
    }
  }

  Result<std::string> sendOne(std::optional<Association>& association, std::size_t n) {
    if (cancel_.cancelled()) return Error{"cancelled"};
    if (!association) {
      auto opened = Association::open(archive_, services_, cancel_);
      if (!opened) return opened.error();
      association.emplace(std::move(*opened));
    }
    auto done = association->store(instances_[n].uids, instances_[n].path);
    if (!done) association.reset();
    return done;
  }

  const Archive& archive_;
  const std::vector<SentInstance>& instances_;
  std::vector<WantedService> services_;
  std::atomic<std::size_t> next_;
  const std::size_t end_;
  const OnSent& onSent_;
  const CancelToken& cancel_;
  std::mutex mutex_;
  Status problem_;
  int failures_ = 0;  // one after the other
  bool isAlone_ = true;
  std::vector<std::size_t> again_;
};

}  // namespace

Status sendByDimse(const Archive& archive, const std::vector<SentInstance>& instances, const OnSent& onSent,
                   const CancelToken& cancel) {
  // DCMTK loads its dictionary on first use. If memory ran out then in a thread, the others would wait for it
  // forever.
  dcmDataDict.rdlock();
  dcmDataDict.rdunlock();
  for (std::size_t first = 0; first < instances.size();) {
    Services services;
    std::size_t end = first;
    while (end < instances.size() && services.add(instances[end].uids)) ++end;
    if (Status s = Sending(archive, instances, first, end, onSent, cancel)(); !s) return s;
    first = end;
  }
  return {};
}

}  // namespace volumen
