#pragma once

#include <atomic>
#include <memory>

namespace volumen {

/// Says to long work that nobody waits for it any more, and hears how far it is. Copies share one state;
/// checked between rows, slices, files.
class CancelToken {
 public:
  void cancel() const { state_->cancelled.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return state_->cancelled.load(std::memory_order_relaxed); }

  /// How much of the work is done, 0 to 1, where whoever does it says so; else 0.
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
