#pragma once

#include <atomic>
#include <memory>

namespace volumen {

/// Says to long work that nobody waits for it any more. Copies share one flag; checked between rows, slices,
/// files.
class CancelToken {
 public:
  void cancel() const { flag_->store(true, std::memory_order_relaxed); }
  bool cancelled() const { return flag_->load(std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace volumen
