#include <algorithm>
#include <map>
#include <set>

#include "app/exports/chosen_pictures.h"
#include "app/exports/drawn_pictures.h"
#include "app/frame_picture.h"
#include "app/picture_output.h"
#include "app/progress.h"
#include "io/frames.h"
#include "results/series/frames_window.h"

namespace volumen {

namespace {

/// Draws the frames of one series as acquired. Those whose file has no window share one.
class FrameDrawer {
 public:
  FrameDrawer(const Series& series, const std::optional<Window>& window) : series_(series), asked_(window) {}

  Status draw(int index, const PictureTaker& taker, std::vector<std::string>& notes) {
    const Result<Frame> frame = loadFrame(series_, index);
    if (!frame) return frame.error();
    PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
    for (const std::string& warning : frame->warnings) note(warning, notes);
    if (asked_ && frame->colour()) note("It is in colour, which --window does not change.", notes);
    const auto picture = withSquarePixels(
        pictureOfBytes(frameBytes(*frame, windowOf(index, *frame)), frame->size, frame->colour()),
        frame->pixel.mm);
    return picture ? taker.take(*picture, text) : picture.error();
  }

 private:
  // Each sentence is said once.
  void note(const std::string& sentence, std::vector<std::string>& notes) {
    if (said_.insert(sentence).second) notes.push_back(sentence);
  }

  std::optional<Window> windowOf(int index, const Frame& frame) {
    if (asked_ || frame.colour() || !frame.greys.front().ofValues) return asked_;
    const auto [first, last] = framesOfOneWindow(series_, index);
    const auto [known, isNew] = windows_.try_emplace(first);
    if (isNew) known->second = windowOfFrames(series_, first, last);
    return known->second;
  }

  const Series& series_;
  const std::optional<Window>& asked_;
  std::map<int, std::optional<Window>> windows_;  // by the first frame that shares it
  std::set<std::string> said_;
};

}  // namespace

Result<Exported> drawFrames(const ExportJob& job, const PictureTaker& taker, const CancelToken& cancel) {
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  const Result<Study> study = openStudyAt(job.path, cancel);
  if (!study) return study.error();
  const auto chosen = choosePictures(job.path, *study, job.series, {}, {});
  if (!chosen) return chosen.error();
  const Series& series = chosen->series;
  if (Status s = checkLosses(job.path, series.unread); !s) return s.error();
  Exported exported{chosen->notes, series.unread};
  const auto count = chosen->indices.size();
  if (Status s = taker.begin(series, int(count)); !s) return s.error();
  FrameDrawer drawer(series, *window);
  const Progress progress = terminalProgress();
  Status taken;
  for (std::size_t n = 0; n < count && taken; ++n) {
    taken = cancel.cancelled() ? Status(Error{"Interrupted; nothing was written."})
                               : drawer.draw(chosen->indices[n], taker, exported.notes);
    if (count > 1 && progress) progress("drawing", n + 1, count);
  }
  endTerminalProgress();
  if (!taken) return taken.error();
  return exported;
}

}  // namespace volumen
