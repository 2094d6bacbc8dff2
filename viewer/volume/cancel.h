#pragma once

#include <atomic>
#include <memory>

namespace volumen {

/// Cancels long work and reports its progress. Copies share one state. Work checks it between rows, slices or
/// files.
class CancelToken {
 public:
  void cancel() const { state_->cancelled.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return state_->cancelled.load(std::memory_order_relaxed); }

  /// Returns the completed fraction, 0 to 1; 0 if the work does not report it.
  double done() const { return state_->done.load(std::memory_order_relaxed); }
  void setDone(double part) const { state_->done.store(part, std::memory_order_relaxed); }

 private:
  struct State {
    std::atomic<bool> cancelled{false};
    std::atomic<double> done{0};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace volumen
