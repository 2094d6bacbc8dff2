#pragma once

#include <QSignalSpy>
#include <algorithm>
#include <atomic>

#include "tests/fixtures/small_volumes.h"
#include "ui/controller/draw_service.h"

namespace volumen::tests {

VolumePtr smallVolume(std::int16_t value = 1);

// Draws a plain picture, row by row at a given speed. Its grey is the intensity of the first light.
struct SlowRenderer {
  std::atomic<int> msPerRow{0};
  std::atomic<int> microsecondsPerPixel{0};
  std::atomic<bool> plansForEver{false};  ///< until they are cancelled; drafts are not affected
  std::atomic<int> begun{0}, cancelled{0};
  std::atomic<int> plansBegun{0}, plansCancelled{0};

  MakeDraw make() {
    return [this](const VoxelsPtr&) -> Draw {
      return {[this](const auto&... asked) { return plan(asked...); },
              [this](const auto&... asked) { return picture(asked...); }};
    };
  }

 private:
  Result<Planned> plan(const Scene& scene, const RenderOptions& options, const CancelToken& cancel) {
    ++plansBegun;
    while (plansForEver && options.quality != Quality::draft && !cancel.cancelled()) QThread::msleep(1);
    if (cancel.cancelled()) {
      ++plansCancelled;
      return Error{"cancelled"};
    }
    Planned planned;
    planned.plan.scene = scene;
    planned.plan.options = options;
    return planned;
  }

  Result<Drawn> picture(const Planned& planned, const CancelToken& cancel) {
    const RenderOptions& options = planned.plan.options;
    ++begun;
    Drawn drawn;
    drawn.picture.size = options.size;
    drawn.picture.rgba.assign(std::size_t(4) * options.size.x * options.size.y, 1.0f);
    for (int y = 0; y < options.size.y; ++y) {
      if (cancel.cancelled()) {
        ++cancelled;
        return Error{"cancelled"};
      }
      if (msPerRow > 0) QThread::msleep(unsigned(msPerRow));
      if (microsecondsPerPixel > 0) QThread::usleep(unsigned(microsecondsPerPixel * options.size.x));
      for (int x = 0; x < options.size.x; ++x)
        for (int c = 0; c < 3; ++c)
          drawn.picture.row(y)[4 * x + c] = float(planned.plan.scene.lights[0].intensity);
    }
    return drawn;
  }
};

Scene greyScene(double grey);

RenderOptions ofSize(int width, int height);

/// A service whose view 0 shows a volume, and a record of all its messages.
struct Watched {
  const VolumePtr volume = smallVolume();
  std::vector<ScreenPicture> pictures;
  std::map<int, std::vector<Answer>> answers;  ///< by number of the request
  QStringList failures;
  DrawService service;  ///< last, because it answers until it is destroyed

  explicit Watched(MakeDraw make) : service(std::move(make)) {
    QObject::connect(&service, &DrawService::screenPictureReady, &service,
                     [this](const ScreenPicture& picture) { pictures.push_back(picture); });
    QObject::connect(&service, &DrawService::answered, &service,
                     [this](ViewId, int number, Answer answer) { answers[number].push_back(answer); });
    QObject::connect(&service, &DrawService::failed, &service,
                     [this](ViewId, const QString& sentence) { failures << sentence; });
    service.show(0, volume);
  }
  /// Counts pictures without the finer drafts that a busy machine adds when a draft is slow.
  int withoutFinerDrafts() const {
    int count = 0, drafted = 0;  // number of the request of the last draft
    for (const ScreenPicture& p : pictures) {
      count += !p.draft() || p.number != drafted;
      if (p.draft()) drafted = p.number;
    }
    return count;
  }
  bool atRest() const { return !pictures.empty() && !pictures.back().draft(); }
  /// Returns the only answer to a request.
  std::optional<Answer> answerTo(int number) const {
    const auto found = answers.find(number);
    return found != answers.end() && found->second.size() == 1 ? std::optional(found->second[0])
                                                               : std::nullopt;
  }
};

}  // namespace volumen::tests
