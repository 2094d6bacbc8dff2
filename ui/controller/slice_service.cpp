#include "ui/controller/slice_service.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "ui/controller/picture_underneath.h"

namespace volumen {

namespace {

// Adds tints and segments to the picture underneath.
Result<QImage> withTintsAndSegments(Result<QImage> picture, const SliceRequest& request) {
  for (const SliceLayer& layer : request.layers)
    if (layer.tinted && picture) picture = withTint(std::move(*picture), layer, request.plane);
  if (!picture) return picture;
  for (const SegmentLayer& layer : request.segments)
    *picture = withSegments(std::move(*picture), request.plane, layer);
  return picture;
}

struct SlicePictureOrNot {
  std::optional<SliceRequest> request;  // empty if it was dropped
  Result<QImage> image = QImage();
};

}  // namespace

Result<QImage> drawSlice(const SliceRequest& request) {
  return withTintsAndSegments(drawUnderneath(request), request);
}

// Requests that are not begun; used by both threads.
class SliceService::Queue {
 public:
  struct Turn {
    SliceRequest request;
    std::shared_ptr<PictureUnderneath> underneath;  // for the lane's thread
  };

  // Returns false if it replaces a waiting request.
  bool ask(SliceRequest latest, bool isInFocus) {
    const std::lock_guard lock(mutex_);
    const auto before = std::ranges::find(waiting_, pictureOf(latest), &Waiting::picture);
    if (before != waiting_.end()) {
      *before = {std::move(latest), isInFocus};
      return false;
    }
    waiting_.push_back({std::move(latest), isInFocus});
    return true;
  }

  void drop(ViewId view) {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [view](const Waiting& one) { return one.request.view == view; });
  }

  std::optional<Turn> next() {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return {};
    auto chosen = std::ranges::find_if(
        waiting_, [this](const Waiting& one) { return one.isInFocus && one.picture() != last_; });
    if (chosen == waiting_.end()) chosen = waiting_.begin();
    Turn turn{std::move(chosen->request), {}};
    waiting_.erase(chosen);
    last_ = pictureOf(turn.request);
    auto& underneath = underneath_[*last_];
    if (!underneath) underneath = std::make_shared<PictureUnderneath>();
    turn.underneath = underneath;
    return turn;
  }

 private:
  using Picture = std::pair<ViewId, bool>;  // a view, and whether it is its lens
  static Picture pictureOf(const SliceRequest& request) { return {request.view, request.ofLens}; }
  struct Waiting {
    SliceRequest request;
    bool isInFocus = false;
    Picture picture() const { return pictureOf(request); }
  };

  std::mutex mutex_;
  std::vector<Waiting> waiting_;  // in the order of the requests
  std::optional<Picture> last_;
  std::map<Picture, std::shared_ptr<PictureUnderneath>> underneath_;
};

SliceService::SliceService(QObject* parent) : QObject(parent), queue_(std::make_shared<Queue>()) {}

void SliceService::request(SliceRequest latest, bool isInFocus) {
  if (!queue_->ask(std::move(latest), isInFocus)) return;
  lane_.run(
      {},
      [queue = queue_](const Job&) {
        const std::optional<Queue::Turn> turn = queue->next();
        if (!turn) return SlicePictureOrNot{};
        const SliceRequest& request = turn->request;
        return SlicePictureOrNot{
            request, orNoMemory([&] {
              return withTintsAndSegments(
                  request.frame ? drawUnderneath(request) : turn->underneath->of(request), request);
            })};
      },
      [this](const SlicePictureOrNot& drawn) {
        if (!drawn.request) return;
        if (drawn.image)
          Q_EMIT ready({*drawn.request, *drawn.image});
        else
          Q_EMIT failed(drawn.request->view, QString::fromStdString(drawn.image.message()));
      });
}

void SliceService::drop(ViewId view) { queue_->drop(view); }

}  // namespace volumen
