#include "io/dicom/kept_headers.h"

#include <deque>
#include <mutex>
#include <unordered_map>

namespace volumen::dicom {
namespace {

class KeptHeaders {
 public:
  void keep(const std::string& path, const FileState& state, const FileHeader& header) {
    const std::lock_guard lock(mutex_);
    const auto [at, isNew] = kept_.try_emplace(path);
    if (isNew)
      order_.push_back(path);
    else
      slices_ -= at->second.header->slices.size();
    at->second = {state, std::make_shared<FileHeader>(header)};
    slices_ += header.slices.size();
    while (slices_ > mostSlices && order_.size() > 1) forgetFirst();
  }

  std::shared_ptr<const FileHeader> find(const std::string& path, const FileState& state) const {
    const std::lock_guard lock(mutex_);
    const auto at = kept_.find(path);
    return at != kept_.end() && at->second.state == state ? at->second.header : nullptr;
  }

 private:
  static constexpr std::size_t mostSlices = 20'000;  ///< about 1 KB each

  struct Kept {
    FileState state;
    std::shared_ptr<const FileHeader> header;
  };

  void forgetFirst() {
    const auto at = kept_.find(order_.front());
    slices_ -= at->second.header->slices.size();
    kept_.erase(at);
    order_.pop_front();
  }

  mutable std::mutex mutex_;
  std::unordered_map<std::string, Kept> kept_;
  std::deque<std::string> order_;  ///< in which they were kept first
  std::size_t slices_ = 0;
};

KeptHeaders& keptHeaders() {
  static KeptHeaders kept;
  return kept;
}

}  // namespace

void keepHeader(const std::string& path, const FileState& state, const FileHeader& header) {
  if (!mayChangeUnseen(state)) keptHeaders().keep(path, state, header);
}

std::shared_ptr<const FileHeader> keptHeader(const std::string& path) {
  const auto state = fileState(path);
  return state ? keptHeaders().find(path, *state) : nullptr;
}

}  // namespace volumen::dicom
