#include "io/dicom/kept_headers.h"

#include <deque>
#include <mutex>
#include <unordered_map>

namespace volumen::dicom {
namespace {

class KeptHeaders {
 public:
  void keep(const std::string& path, const FileState& state, std::shared_ptr<const FileHeader> header) {
    const std::lock_guard lock(mutex_);
    const bool isFresh = mayChangeUnseen(state);
    if (isFresh && holders_ == 0) return;
    const auto [at, isNew] = kept_.try_emplace(path);
    if (isNew)
      order_.push_back(path);
    else
      slices_ -= at->second.header->slices.size();
    slices_ += header->slices.size();
    at->second = {state, std::move(header), isFresh};
    forgetBeyondLimit();
  }

  std::shared_ptr<const FileHeader> find(const std::string& path, const FileState& state) const {
    const std::lock_guard lock(mutex_);
    const auto at = kept_.find(path);
    return at != kept_.end() && at->second.state == state ? at->second.header : nullptr;
  }

  void hold() {
    const std::lock_guard lock(mutex_);
    ++holders_;
  }

  void release() {
    const std::lock_guard lock(mutex_);
    if (--holders_ > 0) return;
    std::erase_if(order_, [this](const std::string& path) {
      const bool isFresh = kept_.at(path).isFresh;
      if (isFresh) erase(path);
      return isFresh;
    });
    forgetBeyondLimit();
  }

 private:
  static constexpr std::size_t mostSlices = 20'000;  ///< about 1 KB each

  struct Kept {
    FileState state;
    std::shared_ptr<const FileHeader> header;
    bool isFresh = false;  ///< the file was just written and may have changed unseen since
  };

  void forgetBeyondLimit() {
    while (holders_ == 0 && slices_ > mostSlices && order_.size() > 1) {
      erase(order_.front());
      order_.pop_front();
    }
  }

  void erase(const std::string& path) {
    const auto at = kept_.find(path);
    slices_ -= at->second.header->slices.size();
    kept_.erase(at);
  }

  mutable std::mutex mutex_;
  std::unordered_map<std::string, Kept> kept_;
  std::deque<std::string> order_;  ///< paths in the order of their first keeping
  std::size_t slices_ = 0;
  int holders_ = 0;
};

KeptHeaders& keptHeaders() {
  static KeptHeaders kept;
  return kept;
}

}  // namespace

void keepHeader(const std::string& path, const FileState& state, const FileHeader& header) {
  keepHeader(path, state, std::make_shared<FileHeader>(header));
}

void keepHeader(const std::string& path, const FileState& state, std::shared_ptr<const FileHeader> header) {
  keptHeaders().keep(path, state, std::move(header));
}

std::shared_ptr<const FileHeader> keptHeader(const std::string& path) {
  const auto state = fileState(path);
  return state ? keptHeaders().find(path, *state) : nullptr;
}

HeldHeaders::HeldHeaders() { keptHeaders().hold(); }
HeldHeaders::~HeldHeaders() { keptHeaders().release(); }

}  // namespace volumen::dicom
