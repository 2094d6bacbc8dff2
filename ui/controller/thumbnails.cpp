#include "ui/controller/thumbnails.h"

#include <QPainter>
#include <algorithm>
#include <utility>

#include "io/thumbnail.h"
#include "viewer/slice/pyramid.h"

namespace volumen {

namespace {

// Files with more voxels are not read for a thumbnail.
constexpr std::int64_t mostVoxels = 1 << 24;

bool canBeRead(const Series& series) {
  return series.format == "DICOM" ? !series.files.empty() : series.acquired.voxelCount() <= mostVoxels;
}

// Returns a grey frame in memory as loadSmallFrame() reads it; nothing if it would not be reduced.
std::optional<Frame> smallFrameOf(const LoadedFrame& held, int edge) {
  if (held.colour()) return {};
  const Volume& whole = *held.slice->volume;
  std::optional<SmallPicture> small = smallPicture(whole.stored(), glm::ivec2(whole.size()), edge);
  if (!small) return {};
  std::ranges::transform(small->means, small->means.begin(),
                         [&](float v) { return whole.realValue(double(v)); });
  Frame frame;
  frame.size = small->size;
  frame.values = std::move(small->means);
  frame.greys = held.greys;
  frame.pixel = held.pixel;
  frame.pixel.mm *= small->block;
  return frame;
}

Result<QImage> makeThumbnail(const Series& series, int edge, FrameService& frames,
                             const CancelToken& cancel) {
  frames.waitForViews(cancel);
  const LoadedFramePtr held =
      series.files.empty() ? nullptr : frames.find({keyOf(series), int(series.files.size() / 2)});
  const std::optional<Frame> middle = held ? smallFrameOf(*held, edge) : std::nullopt;
  return middle ? thumbnailOf(*middle, series, edge) : thumbnailOf(series, edge, cancel);
}

}  // namespace

QImage squareThumbnail(const QImage& thumbnail, int edge) {
  QImage out(edge, edge, QImage::Format_ARGB32_Premultiplied);
  out.fill(Qt::transparent);
  QPainter(&out).drawImage((edge - thumbnail.width()) / 2, (edge - thumbnail.height()) / 2, thumbnail);
  return out;
}

Thumbnails::Thumbnails(int edge, FrameService& frames, QObject* parent)
    : QObject(parent), edge_(edge), frames_(frames) {
  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, &Thumbnails::begin);
}

void Thumbnails::request(const Series& series) {
  if (!canBeRead(series)) return;
  requested_.push_back(series);
  soon_.start();  // once views have asked for the frames of a study that was just opened
}

void Thumbnails::cancel() {
  requested_.clear();
  lane_.giveUpAll();
}

void Thumbnails::begin() {
  for (const Series& series : std::exchange(requested_, {}))
    lane_.run(
        {},
        [series, edge = edge_, &frames = frames_](const Job& job) {
          Result<QImage> image = makeThumbnail(series, edge, frames, job.cancel());
          if (image) *image = squareThumbnail(*image, edge);
          return image;
        },
        [this, series](const Result<QImage>& image) {
          // If the series cannot be read, a click on it says why.
          if (image) Q_EMIT made(series, *image);
        });
}

}  // namespace volumen
