#include "io/files/sample_data.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>

#include "io/files/text_source.h"
#include "viewer/volume/buffer.h"

namespace volumen {

namespace {

constexpr std::uint64_t mostVolumeBytes = std::uint64_t(16) << 30;
constexpr std::uint64_t mostVolumes = 10000;

// Returns the product; empty if it exceeds `most`.
std::optional<std::uint64_t> product(const std::vector<std::uint64_t>& sizes, std::uint64_t most) {
  std::uint64_t all = 1;
  for (std::uint64_t n : sizes) {
    if (n < 1 || all > most / n) return {};
    all *= n;
  }
  return all;
}

std::uint64_t machineBytes() {
  return std::uint64_t(std::max(0L, sysconf(_SC_PHYS_PAGES))) *
         std::uint64_t(std::max(0L, sysconf(_SC_PAGESIZE)));
}

// The type in which a Volume keeps samples of type T.
template <class T>
using KeptType = std::conditional_t<std::is_same_v<T, std::int8_t>, std::int16_t,
                                    std::conditional_t<sizeof(T) <= 2 || std::is_same_v<T, float>, T, float>>;

template <class T>
T swapped(T sample) {
  auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(sample);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

// Returns the byte position after `lines` line ends from `offset`. They are text, so 1 MiB is the limit.
Result<std::uint64_t> skipLines(const DataFile& file, std::uint64_t offset, int lines) {
  if (lines == 0) return offset;
  std::string text(1 << 20, '\0');
  auto got = file.readAt(offset, text.data(), text.size());
  if (!got) return got.error();
  for (std::size_t n = 0; n < *got; ++n)
    if (text[n] == '\n' && --lines == 0) return offset + n + 1;
  return Error{file.path() + " has fewer lines than its header says are to be skipped."};
}

std::unique_ptr<ByteSource> decodePart(const SampleData& data, DataFile file, std::uint64_t offset,
                                       const CancelToken& cancel) {
  if (data.text)
    return decodeText(std::move(file), offset, {data.type, data.samples() / data.files.size()}, cancel);
  return decode(std::move(file), offset, data.encoding, cancel);
}

// Returns the number of decoded bytes between `offset` and the end.
Result<std::uint64_t> decodedBytes(const SampleData& data, const DataFile& file, std::uint64_t offset,
                                   const CancelToken& cancel) {
  if (data.encoding == Encoding::raw) return file.size() - std::min(file.size(), offset);
  auto source = decode(file, offset, data.encoding, cancel);
  std::vector<std::uint8_t> waste(1 << 18);
  for (std::uint64_t all = 0;;) {
    auto got = source->read(waste.data(), waste.size());
    if (!got) return got.error();
    if (*got == 0) return all;
    all += *got;
  }
}

// All parts of the data as one sequence of bytes.
class Parts {
 public:
  Parts(const SampleData& data, const CancelToken& cancel)
      : data_(data), cancel_(cancel), partBytes_(data.samples() / data.files.size() * bytesOf(data.type)) {}

  Status skip(std::uint64_t count) {
    return forParts(count, [&](std::uint64_t n) { return source_->skip(n, path()); });
  }
  Status read(std::uint8_t* to, std::uint64_t count) {
    return forParts(count, [&](std::uint64_t n) {
      Status s = source_->readAll(to, n, path());
      to += n;
      return s;
    });
  }
  // Reads past the last sample: the checksum there shows if compressed data are intact.
  Status finish() {
    std::uint8_t waste;
    auto got = source_->read(&waste, data_.text ? 0 : 1);
    return got ? Status{} : got.error();
  }

 private:
  const std::string& path() const { return data_.files[next_ - 1]; }

  template <class F>
  Status forParts(std::uint64_t count, F&& f) {
    while (count > 0) {
      if (left_ == 0) {
        if (source_)
          if (Status s = finish(); !s) return s;
        if (Status s = open(); !s) return s;
      }
      const std::uint64_t n = std::min(count, left_);
      if (Status s = f(n); !s) return s;
      left_ -= n;
      count -= n;
    }
    return {};
  }

  Status open() {
    auto file = DataFile::open(data_.files[next_++]);
    if (!file) return file.error();
    auto offset = skipLines(*file, data_.offset, data_.lineSkip);
    if (!offset) return offset.error();
    std::uint64_t skipped = std::uint64_t(std::max<std::int64_t>(0, data_.byteSkip));
    if (data_.byteSkip < 0) {
      auto all = decodedBytes(data_, *file, *offset, cancel_);
      if (!all) return all.error();
      if (*all < partBytes_)
        return Error{path() + " holds fewer samples than its header promises: " + std::to_string(*all) +
                     " of " + std::to_string(partBytes_) + " bytes."};
      skipped = *all - partBytes_;
    }
    if (data_.text) *offset += skipped, skipped = 0;
    source_ = decodePart(data_, std::move(*file), *offset, cancel_);
    left_ = partBytes_;
    return source_->skip(skipped, path());
  }

  const SampleData& data_;
  const CancelToken& cancel_;
  std::uint64_t partBytes_, left_ = 0;
  std::size_t next_ = 0;
  std::unique_ptr<ByteSource> source_;
};

// Converts to real values as float32 and counts the rounded ones.
struct ToFloat {
  double slope, intercept;
  std::uint64_t rounded = 0;
  template <class T>
  float operator()(T stored) {
    constexpr double most = std::numeric_limits<float>::max();
    const double real = slope * double(stored) + intercept;
    const float kept = float(std::abs(real) > most && std::isfinite(real) ? std::copysign(most, real) : real);
    rounded += double(kept) != real && std::isfinite(real);
    return kept;
  }
};

// bzip2 packs so tightly that file size says nothing. The bytes are counted before memory is allocated.
Status checkBzip2(const SampleData& data, const CancelToken& cancel) {
  if (data.encoding != Encoding::bzip2 || data.text) return {};
  Parts parts(data, cancel);
  return parts.skip(data.samples() * bytesOf(data.type));
}

template <class T>
Result<Samples> readType(const SampleData& data, std::uint64_t volume, Samples into, const Progress& progress,
                         const CancelToken& cancel, std::vector<std::string>& warnings) {
  using Kept = KeptType<T>;
  constexpr bool toReal = std::is_same_v<Kept, float> && !std::is_same_v<T, float>;
  const bool swap = !data.text && data.bigEndian != (std::endian::native == std::endian::big);
  const std::uint64_t lead = volume % data.leading;
  if (Status s = checkBzip2(data, cancel); !s) return s.error();
  Parts parts(data, cancel);
  if (Status s = parts.skip(volume / data.leading * data.voxels * data.leading * sizeof(T)); !s)
    return s.error();

  auto values = zeros<Kept>(data.voxels);
  ToFloat toFloat{into.slope, into.intercept};
  const std::uint64_t chunkVoxels = std::max<std::uint64_t>(1, (1 << 18) / data.leading);
  std::vector<T> chunk(chunkVoxels * data.leading);
  for (std::uint64_t done = 0; done < data.voxels;) {
    if (cancel.cancelled()) return Error{"Interrupted."};
    if (progress) progress("reading voxels", done, data.voxels);
    const std::uint64_t count = std::min(chunkVoxels, data.voxels - done);
    if (Status s =
            parts.read(reinterpret_cast<std::uint8_t*>(chunk.data()), count * data.leading * sizeof(T));
        !s)
      return s.error();
    for (std::uint64_t n = 0; n < count; ++n) {
      const T sample = swap ? swapped(chunk[n * data.leading + lead]) : chunk[n * data.leading + lead];
      if constexpr (toReal)
        values[done + n] = toFloat(sample);
      else
        values[done + n] = Kept(+sample);  // +: int8 is a number here, not a character
    }
    done += count;
  }
  if (volume / data.leading + 1 == data.trailing)
    if (Status s = parts.finish(); !s) return s.error();
  if (toFloat.rounded > 0)
    warnings.push_back(std::to_string(toFloat.rounded) +
                       " values have more digits than float32 keeps and were rounded to it.");
  if (toReal) into.slope = 1, into.intercept = 0;
  into.values = std::move(values);
  return into;
}

}  // namespace

Status setCounts(SampleData& data, const std::vector<std::uint64_t>& leading,
                 const std::vector<std::uint64_t>& grid, const std::vector<std::uint64_t>& trailing,
                 const std::string& path) {
  const auto lead = product(leading, mostVolumes), trail = product(trailing, mostVolumes);
  if (!lead || !trail || *lead * *trail > mostVolumes)
    return Error{path + " promises more than " + std::to_string(mostVolumes) +
                 " volumes, which is more than volumen reads from one file."};
  const std::uint64_t most = std::min(mostVolumeBytes, machineBytes());
  const auto voxels = product(grid, most / std::max<std::size_t>(bytesOf(data.type), 4));
  if (!voxels)
    return Error{path + " promises a volume of more than " + std::to_string(most >> 20) +
                 " MiB, which is more than volumen reads on this machine."};
  data.leading = *lead;
  data.voxels = *voxels;
  data.trailing = *trail;
  return {};
}

Status checkFiles(const SampleData& data) {
  if (data.files.empty() || data.samples() % data.files.size() != 0)
    return Error{"The " + std::to_string(data.files.size()) + " data files of " +
                 (data.files.empty() ? std::string("the header") : data.files[0] + " and others") +
                 " cannot hold equal parts of " + std::to_string(data.samples()) + " samples."};
  const std::uint64_t samples = data.samples() / data.files.size();
  const std::uint64_t skipped = std::uint64_t(std::max<std::int64_t>(0, data.byteSkip));
  const std::uint64_t encoded =
      data.text ? samples * 2 - 1 + skipped
                : leastEncodedBytes(data.encoding, samples * bytesOf(data.type) + skipped);
  for (const std::string& path : data.files) {
    auto file = DataFile::open(path);
    if (!file) return file.error();
    if (file->size() < data.offset || file->size() - data.offset < encoded)
      return Error{path + " is too short: it has " + std::to_string(file->size()) +
                   " bytes, but what its header promises needs at least " +
                   std::to_string(data.offset + encoded) + "."};
  }
  return {};
}

const char* volumeTypeName(SampleType type) {
  return withSampleType(type, [](auto sample) {
    using Kept = KeptType<decltype(sample)>;
    if (std::is_same_v<Kept, std::uint8_t>) return "uint8";
    if (std::is_same_v<Kept, std::int16_t>) return "int16";
    if (std::is_same_v<Kept, std::uint16_t>) return "uint16";
    return "float32";
  });
}

Result<Samples> readSamples(const SampleData& data, std::uint64_t volume, double slope, double intercept,
                            const Progress& progress, const CancelToken& cancel,
                            std::vector<std::string>& warnings) {
  if (Status s = checkFiles(data); !s) return s.error();
  try {
    return withSampleType(data.type, [&](auto sample) {
      return readType<decltype(sample)>(data, volume, Samples{{}, slope, intercept}, progress, cancel,
                                        warnings);
    });
  } catch (const std::bad_alloc&) {
    return Error{data.files[0] + " needs more memory than there is: " + std::to_string(data.voxels) +
                 " voxels."};
  }
}

}  // namespace volumen
